// The work under way, how far it is, and the way out of it.
import { button, element, setText } from '../../shared/panels/element';
import { type Store, watch } from '../../shared/state/store';
import type { Doing, RefinementState } from '../state/refinement-state';

/** Shown while something is done that `isOwn`. */
export function createWork(
  parent: HTMLElement,
  store: Store<RefinementState>,
  actions: { cancel(): void },
  isOwn: (doing: Doing) => boolean,
): void {
  const what = element('p', { class: 'note', role: 'status' });
  const progress = element('progress', { max: 1, 'aria-label': 'Work in progress' });
  const cancel = button('Cancel', () => actions.cancel());
  const work = element('div', { class: 'work' }, what, progress, cancel);
  parent.append(work);
  watch(store, ['doing'], ({ doing }) => {
    const own = doing && isOwn(doing) ? doing : null;
    work.hidden = own === null;
    setText(what, own?.what ?? '');
    cancel.hidden = !own?.canCancel;
    if (typeof own?.share === 'number') progress.value = own.share;
    else progress.removeAttribute('value');
  });
}
