// Badges of what each pane shows: its mesh, what a frame costs, and how far it is from fine. Where there is no room
// for all three, what stands beside fine can be chosen.

import { element, setText } from '../../shared/panels/element';
import { createSegments } from '../../shared/panels/segments';
import { createWhyLink } from '../../shared/panels/why-link';
import { type Store, watch } from '../../shared/state/store';
import {
  type GarmentPane,
  PANE_TITLES,
  PANES,
  type RefinementState,
  shownPanes,
  showsFineCloth,
} from '../state/refinement-state';
import { costWords, errorWords, hintedSubsteps, vertices, warningWords } from './garment-words';

function createChoiceBeside(store: Store<RefinementState>) {
  const { control, setOptions, select } = createSegments<'rival' | 'planned'>(
    'beside-fine',
    { class: 'segments beside', 'aria-label': 'Beside the fine mesh' },
    (beside) => store.set({ beside }),
  );
  let shown = '';
  return {
    control,
    show({ isNarrow, beside, rival }: RefinementState, nShown: number) {
      control.hidden = !isNarrow || nShown < 2;
      if (rival !== shown)
        setOptions([
          { value: 'rival', title: PANE_TITLES[rival] },
          { value: 'planned', title: PANE_TITLES.planned },
        ]);
      shown = rival;
      select(beside);
    },
  };
}

/** Words on what a pane shows that no cloth does, and on what may help. */
function createWarning(store: Store<RefinementState>) {
  const sentence = element('p', { role: 'status' });
  let substeps: number | null = null;
  const remedy = element('button', { type: 'button', click: () => store.set({ substeps }) });
  const { link, show: showWhy } = createWhyLink();
  const warning = element('div', { class: 'pane-warning' }, sentence, remedy, link);
  return {
    warning,
    show(pane: GarmentPane) {
      substeps = hintedSubsteps(pane);
      warning.hidden = pane.warnings.length === 0;
      remedy.hidden = substeps === null;
      setText(sentence, warningWords(pane));
      setText(remedy, `Take ${substeps} substeps`);
      showWhy(pane.warnings[0]?.kind);
    },
  };
}

export function createGarmentBadges(parent: HTMLElement, store: Store<RefinementState>): void {
  const { control, show: showChoice } = createChoiceBeside(store);
  const grid = element('div', { class: 'panes garment-panes' });
  parent.append(control, grid);
  const badges = PANES.map((id) => {
    const count = element('span');
    const cost = element('span', { class: 'cost' });
    const error = element('span', { class: id === 'fine' ? 'more' : '' });
    const badge = element(
      'p',
      { class: 'pane-badge garment-badge' },
      element('b', {}, PANE_TITLES[id]),
      count,
      cost,
      error,
    );
    const { warning, show: showWarning } = createWarning(store);
    const cell = element('div', { class: 'pane' }, badge, warning);
    grid.append(cell);
    return { id, cell, count, cost, error, showWarning };
  });
  watch(
    store,
    ['panes', 'phase', 'isNarrow', 'beside', 'rival', 'computeFine', 'fineCloth'],
    (state) => {
      const shown = shownPanes(state);
      grid.style.setProperty('--columns', String(shown.length));
      showChoice(state, shown.includes('fine') ? shown.length : 0);
      for (const { id, cell, count, cost, error, showWarning } of badges) {
        const pane = state.panes[id];
        cell.hidden = !shown.includes(id);
        const isKnown = pane.nVertices > 0;
        setText(count, isKnown ? vertices(pane.nVertices) : 'opening');
        setText(cost, isKnown ? costWords(pane, id !== 'fine' && showsFineCloth(state)) : '');
        setText(error, isKnown ? errorWords(id, pane) : '');
        showWarning(pane);
      }
    },
  );
}
