// A failure, above the stage, until it is dismissed.
import { type Failure, sentenceOf } from '../bindings/answers';
import { element, setText } from './element';

/** A banner that says what went wrong in a sentence. */
export function createFailureBanner(parent: HTMLElement, dismiss: () => void) {
  const sentence = element('p');
  const button = element('button', { type: 'button', click: dismiss }, 'Dismiss');
  const banner = element('div', { class: 'problem', role: 'alert' }, sentence, button);
  parent.append(banner);
  return ({ problem, phase }: { problem: Failure | null; phase: string }) => {
    banner.hidden = problem === null;
    button.hidden = phase === 'broken';
    if (!problem) return;
    setText(sentence, phase === 'broken' ? problem.what : sentenceOf(problem));
  };
}
