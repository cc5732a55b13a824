// What the finer meshes cost and buy, in a sentence and in a table.
import { element, setText } from '../../shared/panels/element';
import { milliseconds, percent, smallLength } from '../../shared/panels/quantity';
import { type Store, watch } from '../../shared/state/store';
import { PANES, type PaneId, type RefinementState } from '../state/refinement-state';
import { distanceSentence, levelsSentence, ONE_MORE_LEVEL } from './garment-words';
import { heading, numberCell } from './table-parts';

function count(number: number | undefined): string {
  return number === undefined ? '–' : String(number);
}

/** Milliseconds of a frame: the equations of motion, and contact. */
function costCells({ panes }: RefinementState, part: 'contact' | 'dynamics'): HTMLElement[] {
  return PANES.map((id) => {
    const { parts, msPerFrame } = panes[id];
    const contact = parts.find(({ name }) => name === 'contact')?.ms ?? 0;
    if (parts.length === 0 || msPerFrame === null) return numberCell('–');
    return numberCell(milliseconds(part === 'contact' ? contact : msPerFrame - contact));
  });
}

function numberTable(state: RefinementState): HTMLElement {
  const { panes } = state;
  const nFine = panes.fine.nVertices;
  const row = (title: string, cells: HTMLElement[]) =>
    element('tr', {}, element('th', { scope: 'row' }, title), ...cells);
  const cells = (text: (id: PaneId) => string) => PANES.map((id) => numberCell(text(id)));
  return element(
    'table',
    { class: 'quantities number-table' },
    element('caption', { class: 'unseen' }, 'Three meshes in numbers'),
    heading('', 'coarse', 'multi', 'fine'),
    element(
      'tbody',
      {},
      row(
        'vertices',
        cells((id) => String(panes[id].nVertices)),
      ),
      row(
        'of fine',
        cells((id) => (nFine > 0 ? percent(panes[id].nVertices / nFine) : '–')),
      ),
      row(
        'a frame',
        cells((id) => milliseconds(panes[id].msPerFrame)),
      ),
      row('– motion', costCells(state, 'dynamics')),
      row('– contact', costCells(state, 'contact')),
      row(
        'points off',
        cells((id) => (id === 'fine' ? '' : smallLength(panes[id].errorM))),
      ),
      row(
        'in the body',
        cells((id) => count(panes[id].faults?.n_inside)),
      ),
      row(
        'in itself',
        cells((id) => count(panes[id].faults?.n_crossings)),
      ),
      row(
        'surface off',
        cells((id) => (id === 'fine' ? '' : smallLength(panes[id].surfaceM))),
      ),
    ),
  );
}

const MEANING =
  'Both distances are RMS to the fine cloth at the same time: of the same points, and of the surfaces, whatever slid along them. Then: vertices inside the body, and edges that go through the cloth itself, which nothing prevents. A frame is 1/30 s. An even mesh of as many vertices as the plan is not shown here; the skirt’s is nearer to fine than the plan, whose small faces lie where the cloth bends most sharply and not where coarse ones miss most.';

export function createNumbersPanel(parent: HTMLElement, store: Store<RefinementState>): () => void {
  const levels = element('p');
  const distance = element('p');
  const { before, link, hash, after } = ONE_MORE_LEVEL;
  const table = element('div');
  parent.append(
    element(
      'section',
      { 'aria-label': 'Numbers' },
      element('h2', {}, 'What it buys'),
      levels,
      element('p', { class: 'one-more-level' }, before, element('a', { href: hash }, link), after),
      distance,
      element(
        'details',
        {},
        element('summary', {}, 'In numbers'),
        table,
        element('p', { class: 'note' }, MEANING),
      ),
    ),
  );
  return watch(store, ['panes'], (state) => {
    setText(levels, levelsSentence(state));
    setText(distance, distanceSentence(state));
    table.replaceChildren(numberTable(state));
  });
}
