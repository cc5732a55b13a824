// Starts and cancels the sweep, and tells how far it is.
import type { Sweep } from '../sim/sweep';
import type { AppState } from '../state/app-state';
import { LEVELS } from '../state/setting';
import { type Store, watch } from '../state/store';
import { choice, element, field, setText } from './element';

export function createSweepPanel(
  parent: HTMLElement,
  store: Store<AppState>,
  sweep: Sweep,
): () => void {
  let finest = 2;
  const levels = choice(
    LEVELS.slice(1).map((level) => ({ value: level, title: `0 to ${level}` })),
    (level) => {
      finest = level;
    },
  );
  levels.select(finest);
  const start = element(
    'button',
    { type: 'button', class: 'wide', click: () => sweep.start(finest) },
    'Measure speed and error',
  );
  const cancel = element(
    'button',
    { type: 'button', class: 'wide', click: () => sweep.cancel() },
    'Cancel',
  );
  const progress = element('progress', { max: 1, 'aria-label': 'Progress of the sweep' });
  const message = element('p', { class: 'note' });
  const open = element(
    'button',
    { type: 'button', class: 'wide', click: () => store.set({ sweepOpen: true }) },
    'Show the chart',
  );
  parent.append(
    element(
      'section',
      { 'aria-label': 'Speed and error' },
      element(
        'p',
        { class: 'note' },
        'How fast, how wrong? Runs this scene with every stepper at several levels, on this device, and compares each with a fine reference.',
      ),
      field('Levels', levels.control),
      start,
      cancel,
      progress,
      message,
      open,
    ),
  );
  return watch(store, ['sweep', 'sweepOpen', 'phase'], (state) => {
    const { phase } = state.sweep;
    const isRunning = phase === 'running';
    start.hidden = isRunning;
    start.disabled = state.phase === 'broken';
    cancel.hidden = !isRunning;
    progress.hidden = !isRunning;
    progress.value = state.sweep.progress;
    open.hidden = state.sweepOpen || state.sweep.rows.length === 0;
    const failed = phase === 'failed' ? 'The sweep failed: ' : '';
    setText(message, `${failed}${state.sweep.message}`);
  });
}
