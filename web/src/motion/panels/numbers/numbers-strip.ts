// The read-out above the toolbar: what the setting costs and how wrong it is, with status and time.
import { fabricNamed } from '../../../shared/fabric/fabric-data';
import { button, element, setText } from '../../../shared/panels/element';
import { digits, milliseconds, percent } from '../../../shared/panels/quantity';
import { type Store, watch } from '../../../shared/state/store';
import type { MotionState } from '../../state/motion-state';
import { ownQuantities, type Setting } from '../../state/setting';
import { costText, type StepCost, stepCostAt } from '../../state/step-cost';
import { errorWords } from './error-words';
import { pullSentence } from './pull-words';

const STATUS_WORDS: Record<MotionState['phase'], string> = {
  loading: 'loading',
  ready: 'paused',
  stopped: 'stopped',
  refused: 'refused',
  broken: 'not available',
};

/** A pace below this is told in words: its digits say no more. */
const SLOWEST_PACE = 0.01;

/** Parts below this share of a step are not worth their room. */
const LEAST_PART = 0.02;

interface Item {
  title: string;
  meaning: string;
  text(state: MotionState): string;
  width: 'narrow' | 'middle' | 'wide';
  /** A second, smaller line. */
  detail(state: MotionState): string;
}

function statusText({ phase, playing, pace, ahead }: MotionState): string {
  if (ahead !== null) return `ahead, ${Math.round(100 * ahead)} %`;
  if (phase !== 'ready' || !playing) return STATUS_WORDS[phase];
  if (pace === null) return 'running';
  return pace < SLOWEST_PACE ? 'running slowly' : `running ${digits(Math.min(pace, 1), 2)} ×`;
}

/** How the weight of the cloth is known. */
export function weightText(setting: Setting): string {
  const { areal_density_kg_per_m2: own } = ownQuantities(setting);
  const { confidence } = fabricNamed(setting.fabric).areal_density_kg_per_m2;
  return own === undefined ? `weight ${confidence}` : 'weight of scene';
}

/** Time of a step as far as it is known of this setting without its run. */
function costOf({ costs, setting }: Pick<MotionState, 'costs' | 'setting'>): StepCost | null {
  return stepCostAt(costs, setting, setting.level);
}

const ITEMS: readonly Item[] = [
  {
    title: 'Status',
    width: 'middle',
    meaning:
      'What the computation does; 1 × keeps up with the clock. Below: step and simulated time.',
    text: statusText,
    detail: ({ numbers }) =>
      numbers ? `step ${numbers.step}, ${numbers.time_s.toFixed(2)} s` : '',
  },
  {
    title: 'Cost of a step',
    width: 'wide',
    meaning:
      'Wall time of one step on this device, from its begin to its end, in parts; mean over at least 50 ms of work.',
    text: (state) => {
      const { timing } = state;
      const cost = costOf(state);
      return timing ? milliseconds(timing.totalMs) : cost ? costText(cost) : '–';
    },
    detail: ({ timing, ...state }) =>
      timing
        ? timing.parts
            .filter(({ ms }) => ms >= LEAST_PART * timing.totalMs)
            .map(({ name, ms }) => `${name.replaceAll('_', ' ')} ${digits(ms, 2)}`)
            .join(' · ')
        : costOf(state)
          ? 'expected, play to measure'
          : 'play to measure',
  },
  {
    title: 'Error',
    width: 'middle',
    meaning:
      'How far the cloth is from a reference now, RMS over its points; or else what the last sweep found for the very same setting.',
    text: (state) => errorWords(state).value,
    detail: (state) => errorWords(state).detail,
  },
  {
    title: 'Stretch',
    width: 'narrow',
    meaning: 'Largest and root-mean-square change of length of the threads, now.',
    text: ({ numbers }) => (numbers ? percent(numbers.largest_stretch) : '–'),
    detail: ({ numbers }) => (numbers ? `RMS ${percent(numbers.rms_stretch)}` : ''),
  },
  {
    title: 'Vertices',
    width: 'narrow',
    meaning: 'Points whose motion is computed.',
    text: ({ summary }) => (summary ? String(summary.n_vertices) : '–'),
    detail: ({ summary }) => (summary ? `${summary.n_triangles} faces` : ''),
  },
  {
    title: 'Fabric',
    width: 'middle',
    meaning: 'The fabric, and how its weight is known; the panel names the source.',
    text: ({ setting }) => setting.fabric.replace(/ \(.*\)/, ''),
    detail: ({ setting }) => weightText(setting),
  },
];

/** The pull of a hand, or the error, in a sentence, with a button for what it takes to know that. */
function createVerdict(store: Store<MotionState>, actions: { bringReference(): void }) {
  const sentence = element('span');
  const ask = button('', () => {
    store.set({ compare: true });
    actions.bringReference();
  });
  return {
    line: element('p', { class: 'verdict' }, sentence, ' ', ask),
    update(state: MotionState) {
      const pulled = pullSentence(state);
      const words = errorWords(state);
      const action = pulled === null ? words.action : undefined;
      setText(sentence, pulled ?? words.sentence);
      setText(ask, action ?? '');
      ask.hidden = action === undefined;
    },
  };
}

export function createNumbersStrip(
  parent: HTMLElement,
  store: Store<MotionState>,
  actions: { bringReference(): void },
): void {
  const cells = ITEMS.map((item) => {
    const value = element('dd');
    const detail = element('dd', { class: 'detail' });
    const cell = element(
      'div',
      { title: item.meaning, class: `cell-${item.width}` },
      element('dt', {}, item.title),
      value,
      detail,
    );
    return { item, value, detail, cell };
  });
  const verdict = createVerdict(store, actions);
  parent.append(
    element('dl', { class: 'numbers' }, ...cells.map(({ cell }) => cell)),
    verdict.line,
  );
  watch(
    store,
    [
      'numbers',
      'held',
      'timing',
      'summary',
      'phase',
      'playing',
      'ahead',
      'pace',
      'sweep',
      'setting',
      'mesh',
      'reference',
      'compare',
      'heat',
      'costs',
    ],
    (state) => {
      for (const { item, value, detail } of cells) {
        setText(value, item.text(state));
        setText(detail, item.detail(state));
      }
      verdict.update(state);
    },
  );
}
