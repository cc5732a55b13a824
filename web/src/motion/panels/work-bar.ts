// Work that takes long, told on the stage: how far it is or how long it took by now, and a way to stop it.
import { button, element, setText } from '../../shared/panels/element';
import { type Store, watch } from '../../shared/state/store';
import { workWords } from '../run/run-words';
import type { MotionState } from '../state/motion-state';

function words({ ahead, busy, setting, summary, startSteps }: MotionState): string {
  if (busy) return `${workWords(busy.type, setting)}: ${busy.seconds} s so far`;
  if (ahead === null || !summary) return '';
  const seconds = (startSteps * summary.step_s).toFixed(2);
  return `Running the first ${seconds} s: ${Math.round(100 * ahead)} %`;
}

export function createWorkBar(
  parent: HTMLElement,
  store: Store<MotionState>,
  actions: { stopWork(): void },
): void {
  const sentence = element('p');
  const progress = element('progress', { max: 1, 'aria-label': 'Progress' });
  const stop = button('Stop', () => actions.stopWork());
  const bar = element('div', { class: 'working work-bar' }, sentence, progress, stop);
  parent.append(bar);
  watch(store, ['ahead', 'busy', 'setting', 'summary'], (state) => {
    const text = words(state);
    bar.hidden = text === '';
    setText(sentence, text);
    if (state.busy || state.ahead === null) progress.removeAttribute('value');
    else progress.value = state.ahead;
  });
}
