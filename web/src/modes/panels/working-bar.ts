// Work that takes long, told on the stage, and the way out of it.
import { button, element, setText } from '../../shared/panels/element';
import { type Store, watch } from '../../shared/state/store';
import type { ModesState } from '../state/modes-state';

export function createWorkingBar(
  parent: HTMLElement,
  store: Store<ModesState>,
  cancel: () => void,
): void {
  const what = element('p', { role: 'status' });
  const bar = element(
    'div',
    { class: 'working modes-working' },
    what,
    element('progress', { 'aria-label': 'Computing' }),
    button('Cancel', cancel),
  );
  parent.append(bar);
  watch(store, ['working'], ({ working }) => {
    bar.hidden = working === null;
    setText(what, working ?? '');
  });
}
