// Parts of the view that are not seen at first.
import type { Store } from '../../shared/state/store';
import type { MotionState } from '../state/motion-state';

/**
 * Brings a part when it is first asked for, and once. Null where it could not be fetched, which is said
 * of `what`; whoever asks again then tries again.
 */
export function later<Part>(
  store: Pick<Store<MotionState>, 'set'>,
  what: string,
  fetch: () => Promise<Part>,
): () => Promise<Part | null> {
  let part: Promise<Part | null> | null = null;
  return () => {
    part ??= fetch().catch(() => {
      part = null;
      const sentence = `${what} could not be fetched. Try again with a network.`;
      store.set({ problem: { source: 'link', sentence } });
      return null;
    });
    return part;
  };
}
