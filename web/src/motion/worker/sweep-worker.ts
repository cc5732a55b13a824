import { serve } from '../../shared/workers/serve';
import createSweep from '../../wasm/sweep.mjs';
import { SweepCore } from './sweep-core';
import type { FromSweep, ToSweep } from './sweep-protocol';

serve<ToSweep, FromSweep>(self, async (post) => new SweepCore(await createSweep(), post));
