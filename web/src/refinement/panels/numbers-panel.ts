// Panel of what the finer meshes cost and buy, in a sentence and in a table.

import { element, setText } from '../../shared/panels/element';
import { milliseconds, percent, smallLength } from '../../shared/panels/quantity';
import { addSection, folded, noteLine } from '../../shared/panels/section';
import { heading, numberCell, rowOf, tableOf } from '../../shared/panels/table-parts';
import { unbroken } from '../../shared/panels/unbroken';
import { type Store, watch } from '../../shared/state/store';
import { comparedPanes, type PaneId, type RefinementState } from '../state/refinement-state';
import { levelsSentence, lossSentence, ONE_MORE_LEVEL } from './garment-words';

function degrees(angle: number | null): string {
  return angle === null ? '–' : `${((180 / Math.PI) * angle).toFixed(1)}°`;
}

function count(number: number | undefined): string {
  return number === undefined ? '–' : String(number);
}

/** Milliseconds of a frame: the equations of motion, and contact. */
function costCells(state: RefinementState, part: 'contact' | 'dynamics'): HTMLElement[] {
  return comparedPanes(state).map((id) => {
    const { parts, msPerFrame } = state.panes[id];
    const contact = parts.find(({ name }) => name === 'contact')?.ms ?? 0;
    if (parts.length === 0 || msPerFrame === null) return numberCell('–');
    return numberCell(milliseconds(part === 'contact' ? contact : msPerFrame - contact));
  });
}

function numberTable(state: RefinementState): HTMLElement {
  const { panes, rival, floor } = state;
  const nFine = panes.fine.nVertices;
  const row = (title: string, cells: HTMLElement[]) => rowOf(title, ...cells);
  const cells = (text: (id: PaneId) => string) =>
    comparedPanes(state).map((id) => numberCell(text(id)));
  /** A distance from fine; in its own column how far a second fine run is. */
  const held = (key: 'foldsM' | 'surfaceM') =>
    cells((id) => smallLength(id === 'fine' ? (floor?.[key] ?? null) : panes[id][key]));
  return tableOf(
    'quantities number-table',
    'Three meshes in numbers',
    heading('', rival, 'multi', 'fine'),
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
        'off fine',
        cells((id) => (id === 'fine' ? '' : smallLength(panes[id].distanceM))),
      ),
      row(
        'shape lost',
        cells((id) => (id === 'fine' ? '' : smallLength(panes[id].lostM))),
      ),
      row(
        'normals off',
        cells((id) => (id === 'fine' ? '' : degrees(panes[id].lostNormalsRad))),
      ),
      row('folds differ', held('foldsM')),
      row('surface off', held('surfaceM')),
      row(
        'in the body',
        cells((id) => count(panes[id].faults?.n_inside)),
      ),
      row(
        'in itself',
        cells((id) => count(panes[id].faults?.n_crossings)),
      ),
    ),
  );
}

const MEANING =
  'Off fine: distance of the shown cloth from the same points of the fine one, root mean square, as the colours and the line above the picture tell it. Shape lost: with every vertex where the same point of the fine cloth is, how far the faces between them are from it, root mean square, and by what angle they are turned. It is the mesh’s own fault, without chance. Folds: how far they stand out around the garment, by their number, over all frames from 2 s on; and the surfaces now. In the column of fine: the same of a second fine run, in air heavier by a millionth. Then: vertices inside the body, and edges that go through the cloth itself, which nothing prevents. A frame is 1/30 s.';

export function createNumbersPanel(parent: HTMLElement, store: Store<RefinementState>): void {
  const levels = element('p');
  const loss = element('p');
  const { before, link, hash, after } = ONE_MORE_LEVEL;
  const table = element('div');
  addSection(
    parent,
    'Numbers',
    element('h2', {}, 'What it buys'),
    levels,
    element('p', { class: 'one-more-level' }, before, element('a', { href: hash }, link), after),
    loss,
    folded('In numbers', {}, table, noteLine(MEANING)),
  );
  watch(store, ['panes', 'rival', 'floor'], (state) => {
    setText(levels, unbroken(levelsSentence(state)));
    setText(loss, unbroken(lossSentence(state)));
    table.replaceChildren(numberTable(state));
  });
}
