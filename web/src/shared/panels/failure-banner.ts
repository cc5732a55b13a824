// A failure, above the stage, until it is dismissed.
import type { Failure } from '../bindings/answers';
import { element, setText } from './element';

/** What went wrong, in a sentence. */
export function createFailureBanner(parent: HTMLElement, dismiss: () => void) {
  const sentence = element('p');
  const button = element('button', { type: 'button', click: dismiss }, 'Dismiss');
  const banner = element('div', { class: 'problem', role: 'alert' }, sentence, button);
  parent.append(banner);
  return ({ problem, phase }: { problem: Failure | null; phase: string }) => {
    banner.hidden = problem === null;
    button.hidden = phase === 'broken';
    if (!problem) return;
    const place =
      problem.where && !problem.what.includes(problem.where) ? `${problem.where}: ` : '';
    const prefix = problem.kind === 'internal' && phase !== 'broken' ? 'The program failed: ' : '';
    setText(sentence, `${prefix}${place}${problem.what}`);
  };
}
