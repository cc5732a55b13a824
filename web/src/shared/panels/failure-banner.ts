// A failure, above the stage, until it is dismissed.
import { type Failure, sentenceOf } from '../bindings/answers';
import { type Store, watch } from '../state/store';
import { button, element, setText } from './element';

interface Failing {
  problem: Failure | null;
  phase: string;
}

/** A banner that says what went wrong in a sentence; `retry` starts anew what is broken. */
export function createFailureBanner(
  parent: HTMLElement,
  store: Store<Failing>,
  retry?: () => void,
): void {
  const sentence = element('p');
  const again = button('Try again', () => retry?.());
  const dismissal = button('Dismiss', () => store.set({ problem: null }));
  const banner = element('div', { class: 'problem', role: 'alert' }, sentence, again, dismissal);
  parent.append(banner);
  watch(store, ['problem', 'phase'], ({ problem, phase }) => {
    banner.hidden = problem === null;
    again.hidden = phase !== 'broken' || !retry;
    dismissal.hidden = phase === 'broken';
    if (!problem) return;
    setText(sentence, phase === 'broken' ? problem.what : sentenceOf(problem));
  });
}
