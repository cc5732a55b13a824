// Badges above each pane: whose it is, what it costs, and the sign that it shows.
import { element, setText } from '../../shared/panels/element';
import { milliseconds, percent } from '../../shared/panels/quantity';
import { type Store, watch } from '../../shared/state/store';
import { caseNamed, SIDES, type Side } from '../state/failure-cases';
import type { FailuresState } from '../state/failures-state';
import { mainSignOf } from './sign-words';

/** Least stretch that is many lengths, however many. */
const MANY = 10;

/** The largest stretch so far: a heap of cloth that has calmed down does not unsay it. */
function stretchWords(most: number): string {
  return most > MANY ? 'stretched many times over' : `stretched by ${percent(most)} so far`;
}

const SIDE_TITLES: Record<Side, string> = { naive: 'Naive', ours: 'Ours' };

function createBadge(parent: HTMLElement, side: Side) {
  const method = element('span');
  const sign = element('span', { class: 'sign' });
  const numbers = element('span', { class: 'side-numbers' });
  const badge = element(
    'p',
    { class: 'side-badge' },
    element('b', {}, SIDE_TITLES[side]),
    method,
    numbers,
    sign,
  );
  parent.append(badge);
  return (shown: FailuresState) => {
    const { caseId, sides, timeS } = shown;
    const { msPerStep, mostStretch } = sides[side];
    setText(method, caseNamed(caseId)[side].words);
    setText(
      numbers,
      timeS === 0
        ? 'not started'
        : `${milliseconds(msPerStep)} a step, ${stretchWords(mostStretch)}`,
    );
    const main = mainSignOf(shown, side);
    badge.classList.toggle('fired', main !== undefined);
    const calm = timeS === 0 ? '' : 'looks right';
    setText(sign, main ? `${main.title}, from ${main.timeS.toFixed(2)} s on` : calm);
  };
}

export function createSideBadges(parent: HTMLElement, store: Store<FailuresState>): void {
  const badges = SIDES.map((side) => createBadge(parent, side));
  watch(store, ['caseId', 'sides', 'timeS'], (state) => {
    for (const show of badges) show(state);
  });
}
