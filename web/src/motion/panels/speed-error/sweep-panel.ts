// Starts and cancels the sweep, and tells how far it is.
import { button, choice, element, field, setText } from '../../../shared/panels/element';
import { shortTime } from '../../../shared/panels/quantity';
import { addSection, noteLine } from '../../../shared/panels/section';
import { type Store, watch } from '../../../shared/state/store';
import type { Model } from '../../../shared/steppers/steppers';
import type { Sweep } from '../../run/sweep';
import type { MotionState } from '../../state/motion-state';
import { levelsOf, PRESETS } from '../../state/setting';
import { expectedSweepS } from '../../state/sweep-cost';
import {
  FINEST_SWEEP,
  KNOWN_PRESET,
  type SweepWish,
  slowSteppers,
  sweptSetting,
} from '../../state/sweep-plan';
import type { SweepState } from '../../state/sweep-state';

/** Finest level of a sweep to begin with: the quickest. */
const FIRST_FINEST = 1;

/** Finest level of a sweep. */
const FINEST = [
  { value: 1, title: 'up to 1' },
  { value: 2, title: 'up to 2' },
  { value: FINEST_SWEEP, title: `up to ${FINEST_SWEEP}` },
];

/** Scenes that a sweep can be of. */
const SCENES = [
  { value: 'known', title: `${PRESETS[KNOWN_PRESET].title}: all errors known` },
  { value: 'shown', title: 'The scene shown' },
] as const;

/** Choices that take part only when they are asked for. */
function slowPicker(onChange: (withSlow: boolean) => void) {
  const input = element('input', { type: 'checkbox', change: () => onChange(input.checked) });
  const title = element('span');
  const line = element('label', { class: 'check' }, input, title);
  return {
    line,
    show(model: Model) {
      const slow = slowSteppers(model);
      line.hidden = slow.length === 0;
      const names = slow.map((row) => `${row.title} up to level ${row.finest_sweep_level}`);
      setText(title, `Also ${names.join(' and ')}, which is slow`);
    },
  };
}

/** How long the rest will take, as far as that is known. */
function timeLeft({ phase, leftS }: SweepState): string {
  if (phase !== 'running' || leftS === null) return '';
  return `, about ${shortTime(1000 * Math.ceil(leftS))} left`;
}

/** Words on what a sweep would take, as far as steps that were timed tell. */
export function expectation(
  { costs, setting }: Pick<MotionState, 'costs' | 'setting'>,
  wish: SweepWish,
): string {
  const seconds = expectedSweepS(costs, setting, wish);
  return seconds === null
    ? 'Play a moment to learn how long it takes.'
    : `About ${shortTime(1000 * Math.max(seconds, 1), 1)} on this device.`;
}

/** How the last sweep went, or how far this one is. */
function messageOf({ sweep }: MotionState): string {
  const { phase, message, rows } = sweep;
  if (phase === 'done' && message === '') return `Done: ${rows.length} settings measured.`;
  const failed = phase === 'failed' ? 'The sweep failed: ' : '';
  return `${failed}${message}${timeLeft(sweep)}`;
}

/** `showChart` opens the chart and brings it into view. */
export function createSweepPanel(
  parent: HTMLElement,
  store: Store<MotionState>,
  sweep: Sweep,
  showChart: () => void,
): void {
  const wish: SweepWish = { finest: FIRST_FINEST, withSlow: false, ofShown: false };
  const scenes = choice(SCENES, (scene) => {
    wish.ofShown = scene === 'shown';
    showWish(store.get());
  });
  scenes.select('known');
  const levels = choice(FINEST, (level) => {
    wish.finest = level;
    showExpectation(store.get());
  });
  levels.select(wish.finest);
  const levelsField = field('Levels', levels.control);
  const slow = slowPicker((withSlow) => {
    wish.withSlow = withSlow;
    showExpectation(store.get());
  });
  const start = button(
    'Measure speed and error',
    () => {
      sweep.start({ ...wish });
      showChart();
    },
    { class: 'wide' },
  );
  const cancel = button('Cancel', () => sweep.cancel(), { class: 'wide' });
  const progress = element('progress', { max: 1, 'aria-label': 'Progress of the sweep' });
  const message = noteLine();
  const expected = noteLine();
  const open = button('Show the chart', showChart, { class: 'wide' });
  addSection(
    parent,
    'Speed and error',
    noteLine(
      'How fast, how wrong? Runs a scene with several methods at several levels, on this device, and compares each with a fine reference.',
    ),
    field('Cloth to measure', scenes.control),
    levelsField,
    slow.line,
    expected,
    start,
    cancel,
    progress,
    message,
    open,
  );
  function showWish(state: MotionState): void {
    const { preset, model } = sweptSetting(state.setting, wish);
    slow.show(model);
    levelsField.hidden = levelsOf(preset).length === 1;
    showExpectation(state);
  }
  function showExpectation(state: MotionState): void {
    expected.hidden = state.sweep.phase === 'running';
    setText(expected, expectation(state, wish));
  }
  watch(store, ['sweep', 'phase', 'setting', 'costs'], (state) => {
    showWish(state);
    const { phase } = state.sweep;
    const isRunning = phase === 'running';
    start.hidden = isRunning;
    start.disabled = state.phase === 'broken';
    cancel.hidden = !isRunning;
    progress.hidden = !isRunning;
    if (state.sweep.progress === null) progress.removeAttribute('value');
    else progress.value = state.sweep.progress;
    open.hidden = state.sweep.rows.length === 0;
    setText(message, messageOf(state));
  });
}
