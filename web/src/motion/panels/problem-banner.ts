// A banner that says what went wrong in a sentence, with what can be done about it.
import { button, element, setText } from '../../shared/panels/element';
import { type Store, watch } from '../../shared/state/store';
import type { MotionRun } from '../run/motion-run';
import type { MotionState } from '../state/motion-state';

export function createProblemBanner(
  parent: HTMLElement,
  store: Store<MotionState>,
  actions: Pick<MotionRun, 'reset' | 'take'>,
): void {
  const sentence = element('p');
  const help = button('', () => {
    const remedy = store.get().problem?.remedy;
    if (remedy) actions.take(remedy);
  });
  const reset = button('Reset', () => actions.reset());
  const dismiss = button('Dismiss', () => store.set({ problem: null }));
  const parts = [sentence, help, reset, dismiss];
  const banner = element('div', { class: 'problem', role: 'alert' }, ...parts);
  parent.append(banner);
  watch(store, ['problem'], ({ problem }) => {
    banner.hidden = problem === null;
    help.hidden = !problem?.remedy;
    setText(help, problem?.remedy?.title ?? '');
    reset.hidden = problem?.source !== 'run';
    dismiss.hidden = problem?.source === 'browser';
    setText(sentence, [problem?.sentence, problem?.help].join(' ').trim());
  });
}
