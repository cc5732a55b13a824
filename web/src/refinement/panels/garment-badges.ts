// What each pane shows: its mesh, what a frame costs, and how far it is from fine. Where there is no room
// for all three, what stands beside fine can be chosen.
import { element, setText } from '../../shared/panels/element';
import { type Store, watch } from '../../shared/state/store';
import { PANE_TITLES, PANES, type RefinementState, shownPanes } from '../state/refinement-state';
import { costWords, errorWords, vertices, warningWords } from './garment-words';

function createChoiceBeside(store: Store<RefinementState>) {
  const options = (['coarse', 'planned'] as const).map((id) => {
    const input = element('input', {
      type: 'radio',
      name: 'beside-fine',
      change: () => store.set({ beside: id }),
    });
    return { id, input };
  });
  const control = element(
    'div',
    { class: 'segments beside', role: 'radiogroup', 'aria-label': 'Beside the fine mesh' },
    ...options.map(({ id, input }) =>
      element('label', {}, input, element('span', {}, PANE_TITLES[id])),
    ),
  );
  return {
    control,
    show({ isNarrow, beside }: RefinementState, nShown: number) {
      control.hidden = !isNarrow || nShown < 2;
      for (const { id, input } of options) input.checked = id === beside;
    },
  };
}

export function createGarmentBadges(
  parent: HTMLElement,
  store: Store<RefinementState>,
): () => void {
  const { control, show: showChoice } = createChoiceBeside(store);
  const grid = element('div', { class: 'panes garment-panes' });
  parent.append(control, grid);
  const badges = PANES.map((id) => {
    const count = element('span');
    const cost = element('span', { class: 'more' });
    const error = element('span', { class: id === 'fine' ? 'more' : '' });
    const badge = element(
      'p',
      { class: 'pane-badge garment-badge' },
      element('b', {}, PANE_TITLES[id]),
      count,
      cost,
      error,
    );
    const warning = element('p', { class: 'pane-warning', role: 'status' });
    const cell = element('div', { class: 'pane' }, badge, warning);
    grid.append(cell);
    return { id, cell, count, cost, error, warning };
  });
  return watch(store, ['panes', 'phase', 'isNarrow', 'beside', 'computeFine'], (state) => {
    const shown = shownPanes(state);
    grid.style.setProperty('--columns', String(shown.length));
    showChoice(state, shown.includes('fine') ? shown.length : 0);
    for (const { id, cell, count, cost, error, warning } of badges) {
      const pane = state.panes[id];
      cell.hidden = !shown.includes(id);
      const isKnown = pane.nVertices > 0;
      setText(count, isKnown ? vertices(pane.nVertices) : 'opening');
      setText(cost, isKnown ? costWords(pane) : '');
      setText(error, isKnown ? errorWords(id, pane) : '');
      setText(warning, warningWords(pane));
    }
  });
}
