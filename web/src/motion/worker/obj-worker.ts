import type { PleatModule } from '../../shared/bindings/pleat-module';
import { givenCore } from '../../shared/workers/given-core';
import { serve } from '../../shared/workers/serve';
import { readObj } from './obj-core';
import type { FromObj, ToObj } from './obj-protocol';

serve<ToObj, FromObj>(self, async (post) => {
  const module = await givenCore<PleatModule>();
  return { receive: (message) => post(readObj(module, message), []) };
});
