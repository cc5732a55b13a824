import { givenCore } from '../../shared/workers/given-core';
import { serve } from '../../shared/workers/serve';
import type { RefinementModule } from '../bindings/refinement-module';
import { ExampleCore } from './example-core';
import type { FromExample, ToExample } from './garment-protocol';

serve<ToExample, FromExample>(
  self,
  async (post) => new ExampleCore(await givenCore<RefinementModule>(), post),
);
