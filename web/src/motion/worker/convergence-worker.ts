import { givenCore } from '../../shared/workers/given-core';
import { serve } from '../../shared/workers/serve';
import type { ConvergenceModule } from '../bindings/convergence-module';
import { studyConvergence } from './convergence-core';
import type { FromConvergence, ToConvergence } from './convergence-protocol';

serve<ToConvergence, FromConvergence>(self, async (post) => {
  const module = await givenCore<ConvergenceModule>();
  return { receive: (message) => studyConvergence(module, message, post) };
});
