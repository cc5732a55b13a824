import { serve } from '../../shared/workers/serve';
import createSweep from '../../wasm/sweep.mjs';
import { runSweep } from './sweep-core';
import type { FromSweep, ToSweep } from './sweep-protocol';

serve<ToSweep, FromSweep>(self, async (post) => {
  const module = await createSweep();
  return { receive: (message) => runSweep(module, message, post) };
});
