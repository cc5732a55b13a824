import { givenCore } from '../../shared/workers/given-core';
import { serve } from '../../shared/workers/serve';
import type { DeformModule } from '../bindings/deform-module';
import { DeformCore } from './deform-core';
import type { FromDeform, ToDeform } from './deform-protocol';

// Messages that came meanwhile get their turn between two slices of work.
const turns = new MessageChannel();

serve<ToDeform, FromDeform>(self, async (post) => {
  const core = new DeformCore(await givenCore<DeformModule>(), post, {
    later: () => turns.port2.postMessage(null),
    nowMs: () => performance.now(),
  });
  turns.port1.onmessage = () => core.advance();
  return core;
});
