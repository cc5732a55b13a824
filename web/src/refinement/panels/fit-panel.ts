// The light that tells whether the motion is of the examples' kind, and what to do when it is not.
import { button, element, setText } from '../../shared/panels/element';
import { type Store, watch } from '../../shared/state/store';
import { planStory } from '../state/plan-file';
import { canPlanAnew, type RefinementState } from '../state/refinement-state';
import { anewSentence, fitReading } from './garment-words';
import { createWork } from './work';

export function createFitPanel(
  parent: HTMLElement,
  store: Store<RefinementState>,
  actions: { cancel(): void },
): void {
  const light = element('span', { class: 'fit-light', 'aria-hidden': 'true' });
  const title = element('b');
  const detail = element('p', { class: 'note fit-detail' });
  const reason = element('p', { class: 'note', id: 'plan-anew-reason' });
  // It keeps the focus while it cannot be pressed: what it began is still on its way.
  const anew = button(
    'Plan anew with this motion too',
    () => {
      const state = store.get();
      if (canPlanAnew(state)) store.set({ further: [...state.further, state.motion] });
    },
    { class: 'wide', 'aria-describedby': reason.id },
  );
  const below = element('div', { class: 'fit-below' }, reason);
  parent.append(
    element(
      'section',
      { 'aria-label': 'Does the example fit?', class: 'fit' },
      element('h2', {}, 'Does the example still fit?'),
      element('p', { class: 'fit-title' }, light, title),
      detail,
      anew,
      below,
    ),
  );
  const cancel = () => {
    actions.cancel();
    anew.focus();
  };
  createWork(below, store, { cancel }, ({ share }) => share !== null);
  watch(store, ['fit', 'plan', 'phase', 'doing', 'motion', 'fabric', 'further'], (state) => {
    const reading = fitReading(state.fit, state.plan && planStory(state.plan));
    light.dataset.light = reading.light;
    setText(title, reading.title);
    setText(detail, reading.detail);
    anew.setAttribute('aria-disabled', String(!canPlanAnew(state)));
    reason.hidden = typeof state.doing?.share === 'number';
    setText(reason, anewSentence(state));
  });
}
