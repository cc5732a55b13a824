import { givenCore } from '../../shared/workers/given-core';
import { serve } from '../../shared/workers/serve';
import type { SweepModule } from '../bindings/sweep-module';
import { SweepCore } from './sweep-core';
import type { FromSweep, ToSweep } from './sweep-protocol';

serve<ToSweep, FromSweep>(
  self,
  async (post) => new SweepCore(await givenCore<SweepModule>(), post),
);
