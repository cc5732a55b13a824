// Asks for the coarser levels of the loaded cloth, for as long as one of them is drawn.
import { type Store, watch } from '../../shared/state/store';
import type { LevelsMessage } from '../../shared/workers/motion-protocol';
import { type LevelWish, levelWish } from '../state/coarse-levels';
import type { MotionState } from '../state/motion-state';

/** The store is told what they are; null until then. */
export function followLevels(
  store: Store<MotionState>,
  /** The answer; null when it comes too late. */
  read: (wish: LevelWish) => Promise<LevelsMessage | null>,
): void {
  let asked = ''; // how they were last asked for
  let askedOf: MotionState['summary'] = null; // and of which mesh: each has a summary of its own
  watch(
    store,
    ['coarse', 'coarseAs', 'setting', 'summary', 'phase'],
    async ({ coarse, coarseAs, setting, summary, phase }) => {
      if (coarse === 0 || phase !== 'ready' || !summary) return;
      const wish = levelWish(setting, coarseAs);
      const key = JSON.stringify(wish);
      if (key === asked && summary === askedOf) return;
      asked = key;
      askedOf = summary;
      store.set({ coarseLevels: null });
      const answer = await read(wish);
      if (!answer || key !== asked || summary !== askedOf) return;
      const { levels, shortage } = answer;
      store.set({ coarseLevels: { levels, shortage } });
    },
  );
}
