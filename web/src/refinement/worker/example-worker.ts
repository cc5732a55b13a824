import { serve } from '../../shared/workers/serve';
import createRefinement from '../../wasm/refinement.mjs';
import { ExampleCore } from './example-core';
import type { FromExample, ToExample } from './garment-protocol';

serve<ToExample, FromExample>(
  self,
  async (post) => new ExampleCore(await createRefinement(), post, () => performance.now()),
);
