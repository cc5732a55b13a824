// Chooses the coarser level that is drawn over the cloth, and tells what it is.
import { type Choice, choice, element, field, setText } from '../../../shared/panels/element';
import { noteLine } from '../../../shared/panels/section';
import { type Store, watch } from '../../../shared/state/store';
import { stepperRow } from '../../../shared/steppers/steppers';
import { LEVEL_MAKERS, levelWish, makerOf } from '../../state/coarse-levels';
import type { MotionState } from '../../state/motion-state';
import { levelWords } from './level-words';

const WHY =
  'A pull goes from vertex to vertex, one a sweep. On a coarser level the same sweep reaches farther: what is far apart is mended there, and the moves are handed to the finer levels.';

const HOW = {
  quadrics:
    'Neighbours were merged one pair after the other, where the shape changes least. Rims and held vertices stay.',
  thinned: 'A vertex went wherever two of its neighbours stay.',
} as const;

export function createLevelForm(parent: HTMLElement, store: Store<MotionState>): void {
  const shown = element('div', { class: 'pair' });
  const makers = choice(
    LEVEL_MAKERS.map((value) => ({ value, title: stepperRow(value).title })),
    (coarseAs) => store.set({ coarseAs }),
  );
  const makerField = field('Made as by', makers.control);
  const words = element('p', { class: 'note', 'aria-live': 'polite' });
  const how = noteLine();
  parent.append(shown, words, how, noteLine(WHY));

  let levels: Choice<number> | null = null;
  let nOffered = -1;
  function offer(n: number): void {
    if (n === nOffered) return;
    nOffered = n;
    const titles = Array.from({ length: n + 1 }, (_, value) => ({
      value,
      title: value === 0 ? 'Off' : `${value}`,
    }));
    levels = choice(titles, (coarse) => store.set({ coarse }));
    shown.replaceChildren(field('Level', levels.control), makerField);
  }

  watch(
    store,
    ['coarse', 'coarseAs', 'coarseLevels', 'setting', 'summary'],
    ({ coarse, coarseAs, coarseLevels, setting, summary }) => {
      const { nCoarser, selection } = levelWish(setting, coarseAs);
      const nFound = coarse > 0 ? coarseLevels?.levels.length : undefined;
      offer(nCoarser);
      levels?.limit((value) => (value > (nFound ?? value) ? 'not of this mesh' : null));
      levels?.select(Math.min(coarse, nFound ?? nCoarser, nCoarser));
      const maker = makerOf(setting, coarseAs);
      makers.limit((value) =>
        maker !== setting.stepper || value === maker ? null : 'not the stepper',
      );
      makers.select(maker);
      const n = summary?.n_vertices ?? 0;
      words.hidden = coarse === 0 || !coarseLevels;
      setText(words, coarseLevels ? levelWords(coarseLevels, coarse, n) : '');
      setText(how, HOW[selection]);
    },
  );
}
