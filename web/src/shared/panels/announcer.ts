// Says to a screen reader what happened: events, not running numbers.
import type { Store } from '../state/store';
import { element, setText } from './element';

/** `sentenceFor` is the sentence for a change, or null when nothing worth saying happened. */
export function createAnnouncer<State>(
  parent: HTMLElement,
  store: Store<State>,
  sentenceFor: (state: State, previous: State) => string | null,
): void {
  const region = element('p', { class: 'unseen', role: 'status', 'aria-live': 'polite' });
  parent.append(region);
  store.subscribe((state, previous) => {
    const sentence = sentenceFor(state, previous);
    if (sentence !== null) setText(region, sentence);
  });
}
