// Says what the worker is at once that takes long enough to be noticed.
import type { Store } from '../../shared/state/store';
import type { ModesState } from '../state/modes-state';

/** Work below this needs no words [ms]. */
const NOTICED_MS = 500;

/** The answer; from half a second on, the state says what is being computed. */
export async function noticed<Answer>(
  store: Store<ModesState>,
  words: string,
  work: Promise<Answer>,
): Promise<Answer> {
  const timer = setTimeout(() => store.set({ working: words }), NOTICED_MS);
  try {
    return await work;
  } finally {
    clearTimeout(timer);
    if (store.get().working === words) store.set({ working: null });
  }
}
