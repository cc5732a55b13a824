import { serve } from '../../shared/workers/serve';
import createPleat from '../../wasm/pleat.mjs';
import type { FromMeasuring, ToMeasuring } from './measuring-protocol';
import { race } from './race-core';
import { studyResponse } from './response-core';

serve<ToMeasuring, FromMeasuring>(self, async (post) => {
  const module = await createPleat();
  return {
    receive(message) {
      const answer =
        message.type === 'race' ? race(module, message) : studyResponse(module, message);
      post(answer, []);
    },
  };
});
