// A failure, above the stage, until it is dismissed.
import { type Failure, sentenceOf } from '../bindings/answers';
import { type Store, watch } from '../state/store';
import { element, setText } from './element';

interface Failing {
  problem: Failure | null;
  phase: string;
}

/** A banner that says what went wrong in a sentence. */
export function createFailureBanner(parent: HTMLElement, store: Store<Failing>): void {
  const dismiss = () => store.set({ problem: null });
  const sentence = element('p');
  const button = element('button', { type: 'button', click: dismiss }, 'Dismiss');
  const banner = element('div', { class: 'problem', role: 'alert' }, sentence, button);
  parent.append(banner);
  watch(store, ['problem', 'phase'], ({ problem, phase }) => {
    banner.hidden = problem === null;
    button.hidden = phase === 'broken';
    if (!problem) return;
    setText(sentence, phase === 'broken' ? problem.what : sentenceOf(problem));
  });
}
