import { serve } from '../../shared/workers/serve';
import createPleat from '../../wasm/pleat.mjs';
import { MotionCore } from './motion-core';
import type { FromMotion, ToMotion } from './motion-protocol';

serve<ToMotion, FromMotion>(self, async (post) => new MotionCore(await createPleat(), post));
