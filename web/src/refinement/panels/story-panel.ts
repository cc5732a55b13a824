// The plan in words and in a small table, and why the face that was asked about is as fine as it is.
import { element, setText } from '../../shared/panels/element';
import { digits, milliseconds, percent, smallLength } from '../../shared/panels/quantity';
import { type Store, watch } from '../../shared/state/store';
import { faceAt, faceStory, planStory } from '../state/plan-file';
import { PANE_TITLES, PANES, type PaneId, type RefinementState } from '../state/refinement-state';
import type { GarmentMesh } from '../worker/garment-protocol';
import { buysSentence, fromTo, storySentences } from './garment-words';
import { PATTERN_COLOURS } from './paints';

function heading(...words: string[]): HTMLElement {
  return element(
    'thead',
    {},
    element('tr', {}, ...words.map((word) => element('th', { scope: 'col' }, word))),
  );
}

function count(number: number | undefined): string {
  return number === undefined ? '–' : String(number);
}

function numberCell(text: string): HTMLElement {
  return element('td', { class: 'number' }, text);
}

/** Pattern, curvature in the example, how many coarse vertices. */
function patternTable({ plan }: RefinementState): HTMLElement {
  const rows = (plan ? planStory(plan).patterns : []).map((pattern, index) => {
    const key = element('span', { class: 'legend-key' });
    key.style.background = PATTERN_COLOURS[index] ?? '';
    return element(
      'tr',
      {},
      element('th', { scope: 'row' }, key, String(index)),
      numberCell(fromTo(pattern.meansPerM)),
      numberCell(fromTo(pattern.deviationsPerM)),
      numberCell(pattern.limitPerM === null ? '–' : digits(pattern.limitPerM, 2)),
      numberCell(String(pattern.nVertices)),
    );
  });
  return element(
    'table',
    { class: 'quantities pattern-table' },
    element('caption', { class: 'unseen' }, 'Patterns, curvature in 1/m'),
    heading('Pattern', 'mean 1/m', 'deviation', 'limit', 'vertices'),
    element('tbody', {}, ...rows),
  );
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

function faceText({ plan, face }: RefinementState, mesh: GarmentMesh | null): string {
  if (!plan || !mesh || face === null)
    return `Press a face of the ${PANE_TITLES.planned.toLowerCase()} mesh to read why it is as fine as it is.`;
  return faceStory(faceAt(mesh.faces, face), plan);
}

export function createStoryPanel(
  parent: HTMLElement,
  store: Store<RefinementState>,
  plannedMesh: () => GarmentMesh | null,
): () => void {
  const sentences = element('p');
  const patterns = element('div');
  const face = element('p', { class: 'face-story', 'aria-live': 'polite' });
  const buys = element('p');
  const numbers = element('div');
  const meaning = element(
    'p',
    { class: 'note' },
    'Both distances are RMS to the fine cloth at the same time: of the same points, and of the surfaces, whatever slid along them. Then: vertices inside the body, and edges that go through the cloth itself, which nothing prevents. A frame is 1/30 s.',
  );
  parent.append(
    element(
      'section',
      { 'aria-label': 'Numbers' },
      element('h2', {}, 'What it buys'),
      buys,
      numbers,
      meaning,
    ),
    element(
      'section',
      { 'aria-label': 'The plan' },
      element('h2', {}, 'The plan’s story'),
      sentences,
      patterns,
      face,
    ),
  );
  const closePlan = watch(store, ['plan', 'face', 'phase'], (state) => {
    setText(sentences, state.plan ? storySentences(planStory(state.plan)) : '');
    patterns.replaceChildren(patternTable(state));
    setText(face, faceText(state, plannedMesh()));
  });
  const closeNumbers = watch(store, ['panes'], (state) => {
    setText(buys, buysSentence(state));
    numbers.replaceChildren(numberTable(state));
  });
  return () => {
    closePlan();
    closeNumbers();
  };
}
