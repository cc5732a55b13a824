// The rule by which the light tells whether the motion is of the examples' kind, and what to do when it is not.
import { button, element, setText } from '../../shared/panels/element';
import { type Store, watch } from '../../shared/state/store';
import { planStory } from '../state/plan-file';
import { canPlanAnew, type RefinementState } from '../state/refinement-state';
import { anewSentence, ruleSentence } from './fit-words';
import { createWork } from './work';

export function createFitPanel(
  parent: HTMLElement,
  store: Store<RefinementState>,
  actions: { cancel(): void },
): void {
  const rule = element('p', { class: 'note' });
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
      { 'aria-label': 'When the example does not fit', class: 'fit' },
      element('h2', {}, 'When the example does not fit'),
      rule,
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
    setText(rule, ruleSentence(state.plan && planStory(state.plan)));
    anew.setAttribute('aria-disabled', String(!canPlanAnew(state)));
    reason.hidden = typeof state.doing?.share === 'number';
    setText(reason, anewSentence(state));
  });
}
