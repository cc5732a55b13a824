import type { PleatModule } from '../bindings/pleat-module';
import { givenCore } from './given-core';
import { MotionCore } from './motion-core';
import type { FromMotion, ToMotion } from './motion-protocol';
import { serve } from './serve';

serve<ToMotion, FromMotion>(
  self,
  async (post) => new MotionCore(await givenCore<PleatModule>(), post),
);
