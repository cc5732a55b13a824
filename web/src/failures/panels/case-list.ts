// The cases to choose from.
import { button, element } from '../../shared/panels/element';
import { addSection } from '../../shared/panels/section';
import { unbroken } from '../../shared/panels/unbroken';
import { type Store, watch } from '../../shared/state/store';
import { CASES } from '../state/failure-cases';
import type { FailuresState } from '../state/failures-state';

export function createCaseList(parent: HTMLElement, store: Store<FailuresState>): void {
  const buttons = CASES.map(({ id, title }) =>
    button(unbroken(title), () => store.set({ caseId: id })),
  );
  addSection(
    parent,
    'Cases',
    element('h2', {}, 'What breaks cloth'),
    element('div', { class: 'case-list' }, ...buttons),
  );
  watch(store, ['caseId'], ({ caseId }) => {
    CASES.forEach(({ id }, index) => {
      buttons[index]?.setAttribute('aria-pressed', String(id === caseId));
    });
  });
}
