// A part of the page that is fetched when it is first asked for.
import type { Store } from '../../shared/state/store';
import type { MotionState } from '../state/motion-state';

/**
 * Returns what has the part made once; whoever asks again after it could not be fetched tries again. `what` begins
 * the sentence then, and `without` is set beside it.
 */
export function later(
  store: Store<MotionState>,
  what: string,
  make: () => Promise<void>,
  without: Partial<MotionState> = {},
): () => Promise<void> {
  let made: Promise<void> | null = null;
  const refuse = (): void => {
    made = null;
    const sentence = `${what} could not be fetched. Try again with a network.`;
    store.set({ ...without, problem: { source: 'link', sentence } });
  };
  return () => {
    made ??= make().catch(refuse);
    return made;
  };
}
