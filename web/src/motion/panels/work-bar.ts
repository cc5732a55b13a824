// Work that takes long, told on the stage: how far it is or how long it took by now, and a way to stop it.
import { button, element, setText } from '../../shared/panels/element';
import { shortTime } from '../../shared/panels/quantity';
import { type Store, watch } from '../../shared/state/store';
import { workWords } from '../run/run-words';
import type { MotionState } from '../state/motion-state';
import { stepCostAt } from '../state/step-cost';

/** Words on the time that a step is expected to take, until it has taken that. */
function ofWords({ busy, costs, setting }: MotionState): string {
  const cost = stepCostAt(costs, setting, setting.level);
  const isOver = busy?.type !== 'step' || !cost || cost.isLeast || cost.ms < 1000 * busy.seconds;
  return isOver ? 'so far' : `of about ${shortTime(cost.ms, 1)}`;
}

function words(state: MotionState): string {
  const { ahead, busy, setting, summary, startSteps } = state;
  if (busy) return `${workWords(busy.type, setting)}: ${busy.seconds} s ${ofWords(state)}`;
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
  watch(store, ['ahead', 'busy', 'setting', 'summary', 'costs'], (state) => {
    const text = words(state);
    bar.hidden = text === '';
    setText(sentence, text);
    if (state.busy || state.ahead === null) progress.removeAttribute('value');
    else progress.value = state.ahead;
  });
}
