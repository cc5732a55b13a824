import { serve } from '../../shared/workers/serve';
import createRefinement from '../../wasm/refinement.mjs';
import { GarmentCore } from './garment-core';
import type { FromGarment, ToGarment } from './garment-protocol';

serve<ToGarment, FromGarment>(
  self,
  async (post) => new GarmentCore(await createRefinement(), post),
);
