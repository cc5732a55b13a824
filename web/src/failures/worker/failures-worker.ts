import { MotionCore } from '../../shared/workers/motion-core';
import type { FromMotion, ToMotion } from '../../shared/workers/motion-protocol';
import { serve } from '../../shared/workers/serve';
import createPleat from '../../wasm/pleat.mjs';

serve<ToMotion, FromMotion>(self, async (post) => new MotionCore(await createPleat(), post));
