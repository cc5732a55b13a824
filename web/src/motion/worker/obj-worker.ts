import { serve } from '../../shared/workers/serve';
import createPleat from '../../wasm/pleat.mjs';
import { readObj } from './obj-core';
import type { FromObj, ToObj } from './obj-protocol';

serve<ToObj, FromObj>(self, async (post) => {
  const module = await createPleat();
  return { receive: (message) => post(readObj(module, message), []) };
});
