// The light that tells whether the motion is of the example's kind.
import { planStory } from '../../state/plan-file';
import type { RefinementState } from '../../state/refinement-state';
import { type Store, watch } from '../../state/store';
import { element, setText } from '../element';
import { fitReading } from './garment-words';

export function createFitPanel(parent: HTMLElement, store: Store<RefinementState>): () => void {
  const light = element('span', { class: 'fit-light', 'aria-hidden': 'true' });
  const title = element('b');
  const detail = element('p', { class: 'note' });
  parent.append(
    element(
      'section',
      { 'aria-label': 'Does the example fit?', class: 'fit' },
      element('h2', {}, 'Does the example still fit?'),
      element('p', { class: 'fit-title' }, light, title),
      detail,
    ),
  );
  return watch(store, ['fit', 'plan'], ({ fit, plan }) => {
    const reading = fitReading(fit, plan && planStory(plan));
    light.dataset.light = reading.light;
    setText(title, reading.title);
    setText(detail, reading.detail);
  });
}
