import { serve } from '../../shared/workers/serve';
import createConvergence from '../../wasm/convergence.mjs';
import { studyConvergence } from './convergence-core';
import type { FromConvergence, ToConvergence } from './convergence-protocol';

serve<ToConvergence, FromConvergence>(self, async (post) => {
  const module = await createConvergence();
  return { receive: (message) => studyConvergence(module, message, post) };
});
