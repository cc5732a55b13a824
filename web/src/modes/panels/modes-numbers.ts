// The strip of numbers above the toolbar: of the mix, or of the shape at the present time.
import { element, setText } from '../../shared/panels/element';
import { digits } from '../../shared/panels/quantity';
import { type Store, watch } from '../../shared/state/store';
import { energyOf } from '../state/material';
import { isSolid, type ModesState } from '../state/modes-state';
import { valueAt } from '../state/timeline';
import { frequencyText } from './mode-words';

interface Item {
  title: string;
  meaning: string;
  /** `move` measures the farthest move of a vertex in the mix at its full swing [m]. */
  text(state: ModesState, move: () => number): string;
}

function mixedModes({ amplitudes, found }: ModesState): string {
  const mixed = amplitudes.flatMap((amplitude, mode) => (amplitude === 0 ? [] : [mode]));
  const [only] = mixed;
  const numbers = only === undefined ? undefined : found?.modes[only];
  if (only === undefined) return 'none';
  if (mixed.length > 1 || !numbers) return `${mixed.length} of them`;
  return `${only + 1}: ${frequencyText(numbers)}`;
}

const OF_MODES: readonly Item[] = [
  {
    title: 'Mode',
    meaning: 'Which modes are mixed in; of a single one its frequency, or × that of the first.',
    text: mixedModes,
  },
  {
    title: 'Farthest move',
    meaning: 'Of a vertex, when all modes are at their full swing.',
    text: (_, move) => `${digits(100 * move(), 2)} cm`,
  },
  {
    title: 'Rigid motions',
    meaning: 'Shifts and turns of the whole body, which bend nothing.',
    text: ({ found }) => (found ? String(found.rigid) : '–'),
  },
];

function ratioText(now: number, rest: number): string {
  return Number.isFinite(now) ? `${digits((100 * now) / rest, 3)} %` : '–';
}

const OF_KEYS: readonly Item[] = [
  {
    title: 'Time',
    meaning: 'In keys: 1 is the first, 2 the second.',
    text: ({ time }) => `key ${(time + 1).toFixed(2)}`,
  },
  {
    title: 'Volume',
    meaning: 'Of the in-between, over that of the first key.',
    text: ({ completion, time }) =>
      completion
        ? ratioText(
            valueAt(completion.frames, time, (frame) => frame.volume_m3),
            completion.frames[0]?.volume_m3 ?? 1,
          )
        : '–',
  },
  {
    title: 'Volume, straight',
    meaning: 'Of the ghost, which goes straight from key to key.',
    text: ({ completion, time }) =>
      completion
        ? ratioText(
            valueAt(completion.frames, time, (frame) => frame.straight_volume_m3),
            completion.frames[0]?.volume_m3 ?? 1,
          )
        : '–',
  },
  {
    title: 'Energy',
    meaning:
      'That soft rubber of this volume needs to get here from the first key; of an open surface, whose thickness is made up, the mean strain instead.',
    text: (state) => {
      const { completion, time } = state;
      if (!completion) return '–';
      const strain = valueAt(completion.frames, time, (frame) => frame.strain);
      if (!isSolid(state)) return `${digits(100 * strain, 2)} % strain`;
      return `${digits(energyOf(strain, completion.frames[0]?.volume_m3 ?? 0), 2)} J`;
    },
  },
];

export function createModesNumbers(
  parent: HTMLElement,
  store: Store<ModesState>,
  move: () => number,
): void {
  const list = element('dl', { class: 'modes-numbers' });
  parent.append(list);
  let items: readonly Item[] = [];
  let values: HTMLElement[] = [];
  function build(next: readonly Item[]): void {
    if (next === items) return;
    items = next;
    values = items.map(() => element('dd', {}));
    list.replaceChildren(
      ...items.map(({ title, meaning }, index) =>
        element('div', { title: meaning }, element('dt', {}, title), values[index] ?? ''),
      ),
    );
  }
  const keys: (keyof ModesState)[] = ['showing', 'found', 'amplitudes', 'time', 'completion'];
  watch(store, keys, (state) => {
    build(state.showing === 'modes' ? OF_MODES : OF_KEYS);
    items.forEach(({ text }, index) => {
      const value = values[index];
      if (value) setText(value, text(state, move));
    });
  });
}
