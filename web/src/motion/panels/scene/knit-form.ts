// The form of a knitted cloth: its particles, its springs and dampers, and its pattern.
import { button, choice, element, field, setText } from '../../../shared/panels/element';
import { digits } from '../../../shared/panels/quantity';
import { folded, noteLine } from '../../../shared/panels/section';
import { type Store, watch } from '../../../shared/state/store';
import { stepperRow } from '../../../shared/steppers/steppers';
import {
  type DampingPer,
  KNIT_PLACES,
  type Knit,
  type KnitPlace,
  knitTitle,
  MOST_PER_SIDE,
  unitOf,
} from '../../state/knit';
import type { MotionState } from '../../state/motion-state';
import { presetSetting } from '../../state/setting';

const DAMPING_UNITS: readonly { value: DampingPer; title: string }[] = [
  { value: 'm', title: 'N s/m (as meant)' },
  { value: 'mm', title: 'N s/mm (as printed)' },
];

const SPRINGS = ['structural', 'shear', 'bending'] as const;

const FABRIC_NOTE =
  'Of its fabric a knit takes the colour, the thickness, and the friction on solids that have none of their own.';

/** Fields that stand beside each other. */
const LINES: readonly (readonly KnitPlace[])[] = [
  ['columns', 'rows', 'particle_mass_kg'],
  ...SPRINGS.map((kind) => [`${kind}/stiffness_n_per_m`, `${kind}/damping_n_s_per_m`] as const),
  ['pattern/plain_columns', 'pattern/lace_columns', 'pattern/lace_stiffness'],
];

/** Damping ratio of one particle on one spring: c / (2 sqrt(k m)). */
function dampingRatio(knit: Knit, kind: (typeof SPRINGS)[number]): number {
  const inScene = (place: KnitPlace) => knit[place] * unitOf(place, knit.dampingPer).factor;
  const stiffness = inScene(`${kind}/stiffness_n_per_m`);
  const damping = inScene(`${kind}/damping_n_s_per_m`);
  return damping / (2 * Math.sqrt(stiffness * inScene('particle_mass_kg')));
}

/** How a particle swings on one spring of each kind. */
export function dampingWords(knit: Knit): string {
  const ratios = SPRINGS.map((kind) => dampingRatio(knit, kind));
  const words = SPRINGS.map((kind, index) => `${kind} ${digits(ratios[index] ?? null, 2)}`);
  const creeps = ratios.some((ratio) => ratio > 1);
  return `Damping ratios: ${words.join(', ')}. ${creeps ? 'Above 1 it creeps back and does not swing.' : 'Below 1 it swings before it rests.'}`;
}

/** Words on what the stability bound asks for, where the stepper has one; before anything runs. */
export function boundWords({ setting, summary }: Pick<MotionState, 'setting' | 'summary'>): string {
  if (setting.substeps !== 0 || !summary) return '';
  const microseconds = (1e6 * summary.step_s) / summary.substeps;
  const { title } = stepperRow(setting.stepper);
  return `${title} is stable here in substeps of ${digits(microseconds, 2)} µs, so ${summary.substeps} a step; ${stepperRow('imex').title} takes steps of any length.`;
}

/** Why the page does not take a number; empty where it does, and the scene's reader judges. */
export function refusal(place: KnitPlace, value: number): string {
  const title = knitTitle(place);
  if (!Number.isFinite(value)) return `${title}: expected a number.`;
  const isCount = place === 'columns' || place === 'rows';
  return isCount && value > MOST_PER_SIDE
    ? `${title}: expected at most ${MOST_PER_SIDE} on this page, got ${value}.`
    : '';
}

function numberField(place: KnitPlace, onChange: (value: number) => void) {
  const input = element('input', {
    type: 'number',
    step: 'any',
    inputmode: 'decimal',
    change: () => onChange(input.valueAsNumber),
  });
  const box = field('', input);
  const label = box.querySelector('label');
  return {
    box,
    show(knit: Knit) {
      const { form } = unitOf(place, knit.dampingPer);
      input.value = String(knit[place]);
      if (label) setText(label, form ? `${knitTitle(place)}, ${form}` : knitTitle(place));
    },
  };
}

export function createKnitForm(parent: HTMLElement, store: Store<MotionState>): void {
  const refused = element('p', { class: 'note', role: 'status' });
  function change(patch: Partial<Knit>): void {
    const { setting } = store.get();
    if (!setting.knit) return;
    setText(refused, '');
    store.set({ setting: { ...setting, knit: { ...setting.knit, ...patch } } });
  }
  function changeNumber(place: KnitPlace, value: number): void {
    const sentence = refusal(place, value);
    if (sentence === '') return change({ [place]: value });
    const { knit } = store.get().setting;
    if (knit) fields.get(place)?.show(knit);
    setText(refused, sentence);
  }
  const fields = new Map(
    KNIT_PLACES.map((place) => [place, numberField(place, (value) => changeNumber(place, value))]),
  );
  const dampingPer = choice(DAMPING_UNITS, (value) => change({ dampingPer: value }));
  const dampingNote = noteLine();
  const boundNote = noteLine();
  const lines = LINES.map((places) =>
    element('div', { class: 'row' }, ...places.flatMap((place) => fields.get(place)?.box ?? [])),
  );
  const reset = button(
    'Reset the knit',
    () => change(presetSetting(store.get().setting.preset).knit ?? {}),
    { class: 'wide' },
  );
  const box = folded(
    'Knit: particles, springs, pattern',
    { class: 'knit', open: true },
    ...lines.slice(0, -1),
    field('Unit of damping', dampingPer.control, dampingNote),
    ...lines.slice(-1),
    refused,
    boundNote,
    noteLine(FABRIC_NOTE),
    reset,
  );
  parent.append(box);
  watch(store, ['setting', 'summary'], (state) => {
    const { knit } = state.setting;
    box.hidden = !knit;
    if (!knit) return;
    for (const one of fields.values()) one.show(knit);
    dampingPer.select(knit.dampingPer);
    setText(dampingNote, dampingWords(knit));
    setText(boundNote, boundWords(state));
  });
}
