import type { PleatModule } from '../../shared/bindings/pleat-module';
import { givenCore } from '../../shared/workers/given-core';
import { MotionCore } from '../../shared/workers/motion-core';
import type { FromMotion, ToMotion } from '../../shared/workers/motion-protocol';
import { serve } from '../../shared/workers/serve';

serve<ToMotion, FromMotion>(
  self,
  async (post) => new MotionCore(await givenCore<PleatModule>(), post),
);
