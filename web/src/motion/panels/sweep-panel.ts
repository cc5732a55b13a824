// Starts and cancels the sweep, and tells how far it is.
import { choice, element, field, setText } from '../../shared/panels/element';
import { type Store, watch } from '../../shared/state/store';
import { type Model, STEPPERS } from '../../shared/steppers/steppers';
import type { Sweep } from '../run/sweep';
import type { MotionState } from '../state/motion-state';

/** Finest level of a sweep to begin with: some seconds to a minute. */
const FIRST_FINEST = 1;

/** Finest level of a sweep; each one more takes about ten times as long. */
const FINEST = [
  { value: 1, title: '0 to 1' },
  { value: 2, title: '0 to 2' },
  { value: 3, title: '0 to 3, minutes' },
];

/** Which steppers a sweep of that model leaves out at fine levels. */
function sweepLimits(model: Model): string {
  return STEPPERS.filter(({ models }) => models.includes(model))
    .flatMap(({ title, finest_sweep_level: finest }) =>
      finest === undefined
        ? []
        : `${title} takes part up to level ${finest}: beyond, each of its runs takes minutes.`,
    )
    .join(' ');
}

export function createSweepPanel(
  parent: HTMLElement,
  store: Store<MotionState>,
  sweep: Sweep,
): () => void {
  let finest = FIRST_FINEST;
  const levels = choice(FINEST, (level) => {
    finest = level;
  });
  levels.select(finest);
  const limitsNote = element('p', { class: 'note' });
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
        'How fast, how wrong? Runs this scene with the steppers at several levels, on this device, and compares each with a fine reference.',
      ),
      field('Levels', levels.control),
      limitsNote,
      start,
      cancel,
      progress,
      message,
      open,
    ),
  );
  return watch(store, ['sweep', 'sweepOpen', 'phase', 'setting'], (state) => {
    const limits = sweepLimits(state.setting.model);
    limitsNote.hidden = limits === '';
    setText(limitsNote, limits);
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
