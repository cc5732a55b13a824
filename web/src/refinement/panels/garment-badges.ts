// The badge of each pane: its mesh, what a frame costs, and how far it is from fine.
import { element, setText } from '../../shared/panels/element';
import { type Store, watch } from '../../shared/state/store';
import { PANES, type RefinementState } from '../state/refinement-state';
import { costWords, errorWords, PANE_TITLES, vertices } from './garment-words';

export function createGarmentBadges(
  parent: HTMLElement,
  store: Store<RefinementState>,
): () => void {
  const grid = element('div', { class: 'panes garment-panes' });
  parent.append(grid);
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
    grid.append(element('div', { class: 'pane' }, badge));
    return { id, count, cost, error };
  });
  return watch(store, ['panes', 'phase'], ({ panes }) => {
    for (const { id, count, cost, error } of badges) {
      const pane = panes[id];
      const isKnown = pane.nVertices > 0;
      setText(count, isKnown ? vertices(pane.nVertices) : 'opening');
      setText(cost, isKnown ? costWords(pane) : '');
      setText(error, isKnown ? errorWords(id, pane) : '');
    }
  });
}
