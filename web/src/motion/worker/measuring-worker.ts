import type { PleatModule } from '../../shared/bindings/pleat-module';
import { givenCore } from '../../shared/workers/given-core';
import { serve } from '../../shared/workers/serve';
import type { FromMeasuring, ToMeasuring } from './measuring-protocol';
import { race } from './race-core';
import { studyResponse } from './response-core';

serve<ToMeasuring, FromMeasuring>(self, async (post) => {
  const module = await givenCore<PleatModule>();
  return {
    receive(message) {
      const answer =
        message.type === 'race' ? race(module, message) : studyResponse(module, message);
      post(answer, []);
    },
  };
});
