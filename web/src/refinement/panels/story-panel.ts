// The plan in words and in a small table, and why the face that was asked about is as fine as it is.

import { element, setText } from '../../shared/panels/element';
import { addSection } from '../../shared/panels/section';
import { heading, numberCell, rowOf, tableOf } from '../../shared/panels/table-parts';
import { type Store, watch } from '../../shared/state/store';
import { faceAt, faceStory, planStory } from '../state/plan-file';
import { PANE_TITLES, type RefinementState } from '../state/refinement-state';
import type { GarmentMesh } from '../worker/garment-protocol';
import { fromTo, storySentences } from './garment-words';
import { PATTERN_COLOURS } from './paints';

/** Pattern, curvature in the example, how many coarse vertices. */
function patternTable({ plan }: RefinementState): HTMLElement {
  const rows = (plan ? planStory(plan).patterns : []).map((pattern, index) => {
    const key = element('span', { class: 'legend-key' });
    key.style.background = PATTERN_COLOURS[index] ?? '';
    return rowOf(
      [key, String(index)],
      numberCell(fromTo(pattern.meansPerM)),
      numberCell(fromTo(pattern.deviationsPerM)),
      numberCell(String(pattern.nVertices)),
    );
  });
  return tableOf(
    'quantities pattern-table',
    'Patterns, curvature in 1/m',
    heading('Pattern', 'mean 1/m', 'deviation', 'vertices'),
    element('tbody', {}, ...rows),
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
): void {
  const sentences = element('p');
  const patterns = element('div');
  const face = element('p', { class: 'face-story', 'aria-live': 'polite' });
  addSection(parent, 'The plan', element('h2', {}, 'The plan’s story'), sentences, patterns, face);
  watch(store, ['plan', 'face', 'phase'], (state) => {
    setText(sentences, state.plan ? storySentences(planStory(state.plan)) : '');
    patterns.replaceChildren(patternTable(state));
    setText(face, faceText(state, plannedMesh()));
  });
}
