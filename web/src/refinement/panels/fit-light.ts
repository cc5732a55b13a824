// The light beside the panes: whether the motion is of the examples' kind, in what it differs, and by how much.
import { element, setText } from '../../shared/panels/element';
import { type Store, watch } from '../../shared/state/store';
import { planStory } from '../state/plan-file';
import type { RefinementState } from '../state/refinement-state';
import { fitReading } from './fit-words';

export function createFitLight(parent: HTMLElement, store: Store<RefinementState>): void {
  const light = element('span', { class: 'fit-light', 'aria-hidden': 'true' });
  const title = element('b', { class: 'fit-title' });
  const detail = element('span', { class: 'fit-detail' });
  const words = element('p', {}, title, ' ', detail);
  parent.append(
    element(
      'div',
      { class: 'fit-strip', role: 'group', 'aria-label': 'Does the example fit?' },
      light,
      words,
    ),
  );
  watch(store, ['fit', 'plan', 'garment', 'motion', 'fabric', 'further'], (state) => {
    const reading = fitReading(state.fit, state.plan && planStory(state.plan), state);
    light.dataset.light = reading.light;
    setText(title, `${reading.title}.`);
    setText(detail, reading.detail);
  });
}
