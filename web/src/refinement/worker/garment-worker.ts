import { givenCore } from '../../shared/workers/given-core';
import { serve } from '../../shared/workers/serve';
import type { RefinementModule } from '../bindings/refinement-module';
import { GarmentCore } from './garment-core';
import type { FromGarment, ToGarment } from './garment-protocol';

serve<ToGarment, FromGarment>(
  self,
  async (post) => new GarmentCore(await givenCore<RefinementModule>(), post),
);
