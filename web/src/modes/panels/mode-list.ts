// The lowest modes: each alone by its button, any mix by the sliders.
import { button, choice, element, field, setText } from '../../shared/panels/element';
import { addSection, noteLine } from '../../shared/panels/section';
import { createSegments, type Segment } from '../../shared/panels/segments';
import { type Store, watch } from '../../shared/state/store';
import type { Energy } from '../bindings/modal-module';
import { COUNTS, energiesOf, type ModeCount, type ModesState } from '../state/modes-state';
import { ENERGY_TITLES, energyMeaning, frequencyText, modesNote } from './mode-words';

export interface ModeListActions {
  setEnergy(energy: Energy, compares: boolean): void;
  setCount(count: ModeCount): void;
  /** Plays this mode in full and no other. */
  playAlone(mode: number): void;
  setAmplitude(mode: number, amplitude: number): void;
}

/** A slider has whole per cents. */
const FULL = 100;

interface Row {
  item: HTMLElement;
  show(state: ModesState): void;
}

function createRow(mode: number, actions: ModeListActions): Row {
  const number = element('span', { class: 'mode-number' }, String(mode + 1));
  const frequency = element('span', {});
  const alone = element(
    'button',
    {
      type: 'button',
      class: 'mode-alone',
      title: 'Play this mode alone',
      click: () => actions.playAlone(mode),
    },
    number,
    frequency,
  );
  const slider = element('input', {
    type: 'range',
    min: -FULL,
    max: FULL,
    step: 5,
    'aria-label': `Amplitude of mode ${mode + 1}`,
    input: () => actions.setAmplitude(mode, Number(slider.value) / FULL),
  });
  const value = element('span', { class: 'mode-value' });
  return {
    item: element('li', { class: 'mode-row' }, alone, slider, value),
    show({ found, amplitudes, showing }) {
      const numbers = found?.modes[mode];
      setText(frequency, numbers ? frequencyText(numbers) : '–');
      const amplitude = amplitudes[mode] ?? 0;
      const percent = Math.round(FULL * amplitude);
      if (Number(slider.value) !== percent) slider.value = String(percent);
      slider.setAttribute('aria-valuetext', `${percent} per cent`);
      setText(value, `${percent} %`);
      const others = amplitudes.some((one, at) => at !== mode && one !== 0);
      const isAlone = showing === 'modes' && amplitude !== 0 && !others;
      alone.setAttribute('aria-pressed', String(isAlone));
    },
  };
}

/** The choices of an energy, or of both side by side. */
function energyOptions(model: string): Segment<Energy | 'both'>[] {
  const own = energiesOf(model).map((energy) => ({ value: energy, title: ENERGY_TITLES[energy] }));
  return [...own, { value: 'both', title: 'Both' }];
}

export function createModeList(
  parent: HTMLElement,
  store: Store<ModesState>,
  actions: ModeListActions,
): void {
  const energies = createSegments(
    'energy',
    { class: 'segments', 'aria-label': 'Energy' },
    (option: Energy | 'both') =>
      option === 'both' ? actions.setEnergy('volume', true) : actions.setEnergy(option, false),
  );
  let nEnergies = 0;
  const meaning = noteLine();
  const note = noteLine();
  const list = element('ol', { class: 'mode-list', 'aria-label': 'Modes' });
  const count = choice(
    COUNTS.map((value) => ({ value, title: String(value) })),
    actions.setCount,
  );
  const rest = button('All to zero', () => store.set({ amplitudes: [] }), { class: 'wide' });
  addSection(
    parent,
    'Modes',
    element('h2', {}, 'Modes'),
    energies.control,
    meaning,
    list,
    rest,
    note,
    field('How many', count.control),
  );
  let rows: Row[] = [];
  const keys: (keyof ModesState)[] = [
    'found',
    'amplitudes',
    'showing',
    'model',
    'energy',
    'compares',
    'count',
    'surface',
  ];
  watch(store, keys, (state) => {
    const n = state.found?.modes.length ?? 0;
    if (rows.length !== n) {
      rows = Array.from({ length: n }, (_, mode) => createRow(mode, actions));
      list.replaceChildren(...rows.map(({ item }) => item));
    }
    for (const row of rows) row.show(state);
    const options = energyOptions(state.model);
    if (options.length !== nEnergies) energies.setOptions(options);
    nEnergies = options.length;
    energies.select(state.compares ? 'both' : state.energy);
    count.select(state.count);
    rest.disabled = state.amplitudes.every((amplitude) => amplitude === 0);
    setText(meaning, energyMeaning(state));
    setText(note, modesNote(state.found, state));
  });
}
