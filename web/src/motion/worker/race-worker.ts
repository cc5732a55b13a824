import { serve } from '../../shared/workers/serve';
import createPleat from '../../wasm/pleat.mjs';
import { race } from './race-core';
import type { FromRace, ToRace } from './race-protocol';

serve<ToRace, FromRace>(self, async (post) => {
  const module = await createPleat();
  return { receive: (message) => post(race(module, message), []) };
});
