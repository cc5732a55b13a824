// Badges above each pane: whose it is, what it costs, and the sign that it shows.
import { element, setText } from '../../shared/panels/element';
import { milliseconds, percent } from '../../shared/panels/quantity';
import { type Store, watch } from '../../shared/state/store';
import { caseNamed, SIDES, type Side } from '../state/failure-cases';
import type { FailuresState } from '../state/failures-state';
import { SIGN_TITLES, signsOf } from './sign-words';

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
  return ({ caseId, sides, timeS }: FailuresState) => {
    const state = sides[side];
    setText(method, caseNamed(caseId)[side].words);
    setText(
      numbers,
      timeS === 0
        ? 'not started'
        : `${milliseconds(state.msPerStep)} a step, stretch ${percent(state.stretch)}`,
    );
    const [first] = signsOf(state);
    badge.classList.toggle('fired', first !== undefined);
    const calm = timeS === 0 ? '' : 'looks right';
    setText(sign, first ? `${SIGN_TITLES[first.sign]}, ${first.timeS.toFixed(2)} s` : calm);
  };
}

export function createSideBadges(parent: HTMLElement, store: Store<FailuresState>): void {
  const badges = SIDES.map((side) => createBadge(parent, side));
  watch(store, ['caseId', 'sides', 'timeS'], (state) => {
    for (const show of badges) show(state);
  });
}
