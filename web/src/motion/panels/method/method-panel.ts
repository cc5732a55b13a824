// The choice of a method: model, level, stepper, step, and the counts that the stepper reads.
import { choice, element, field, setText } from '../../../shared/panels/element';
import { percent, shortTime, stepTitle } from '../../../shared/panels/quantity';
import { addSection, folded, noteLine } from '../../../shared/panels/section';
import { type Store, watch } from '../../../shared/state/store';
import { canRun, type Model, STEPPERS, stepperRow } from '../../../shared/steppers/steppers';
import { later } from '../../run/later';
import type { MotionRun } from '../../run/motion-run';
import type { MotionState } from '../../state/motion-state';
import {
  COUNTS,
  LEVELS,
  levelNeed,
  levelsOf,
  MODEL_TRAITS,
  MODELS,
  modelsOf,
  type Setting,
  STEPS_PER_SECOND,
  wantedShare,
  withLevel,
  withModel,
  withStepper,
} from '../../state/setting';
import { costText, type StepCost, type StepCosts, stepCostAt } from '../../state/step-cost';
import { countField } from './count-field';

function hasLevels({ preset }: Setting): boolean {
  return levelsOf(preset).length > 1;
}

function levelPicker(onChoice: (level: number) => void) {
  const inputs = LEVELS.map((level) =>
    element('input', {
      type: 'radio',
      name: 'level',
      value: level,
      change: () => onChoice(level),
    }),
  );
  const times = LEVELS.map(() => element('small'));
  const labels = inputs.map((input, level) =>
    element('label', {}, input, element('span', {}, `${level}`, times[level] ?? '')),
  );
  const group = element(
    'fieldset',
    { class: 'field levels' },
    element('legend', {}, 'Refinement level, time of a step'),
    element('div', { class: 'segments' }, ...labels),
  );
  return {
    group,
    show(setting: Setting, costs: StepCosts) {
      group.hidden = !hasLevels(setting);
      LEVELS.forEach((level, index) => {
        const cost = stepCostAt(costs, setting, level);
        const [input, label, time] = [inputs[index], labels[index], times[index]];
        if (!input || !label || !time) return;
        const need = levelNeed(setting, level);
        input.checked = level === setting.level;
        input.disabled = need !== null && !input.checked;
        const known = need ?? (cost && costSentence(cost));
        input.setAttribute('aria-label', `Level ${level}${known ? `, ${known}` : ''}`);
        label.title = known ?? 'Play, and what a step takes is known.';
        setText(time, cost ? costText(cost) : '–');
      });
    },
  };
}

function costSentence({ ms, isMeasured, isLeast }: StepCost): string {
  if (isLeast) return `a step takes more than ${shortTime(ms)}`;
  return isMeasured ? `a step took ${shortTime(ms)}` : `a step takes about ${shortTime(ms)}`;
}

/** Each model with its sentence, or with why this scene cannot have it. */
function modelPicker(onChoice: (model: Model) => void) {
  const lines = MODELS.map((model) => {
    const note = element('span', { class: 'note', id: `model-${model}` });
    const input = element('input', {
      type: 'radio',
      name: 'model',
      'aria-describedby': note.id,
      change: () => onChoice(model),
    });
    const label = element('label', {}, input, MODEL_TRAITS[model].title);
    return { model, input, note, line: element('div', { class: 'option' }, label, note) };
  });
  const group = element(
    'fieldset',
    { class: 'field' },
    element('legend', {}, 'Model'),
    ...lines.map(({ line }) => line),
  );
  return {
    group,
    show({ preset, model: chosen }: Setting) {
      const possible = modelsOf(preset);
      for (const { model, input, note } of lines) {
        const isPossible = possible.includes(model);
        input.checked = model === chosen;
        input.disabled = !isPossible;
        setText(note, isPossible ? MODEL_TRAITS[model].meaning : MODEL_TRAITS[model].need);
      }
    },
  };
}

/** Why a stepper cannot be chosen; null where it can. */
function stepperNeed(stepper: string, setting: Setting): string | null {
  if (!canRun(stepper, setting.model)) return 'needs springs';
  const need = levelNeed({ ...setting, stepper }, setting.level);
  return need && stepper !== setting.stepper ? 'needs a finer level' : null;
}

/** Share of the last step's equations that is left unsolved, by a method that has any. */
function leftWords({ numbers, setting, isCutShort }: MotionState): string {
  if (!numbers?.iterations || !stepperRow(setting.stepper).solves) return '';
  const { residual, iterations } = numbers;
  const end = isCutShort ? 'cut short after' : 'after';
  return `Left unsolved: ${percent(residual)}, ${end} ${iterations} iterations.`;
}

export const STEPPER_CHOICES = STEPPERS.map(({ name, title }) => ({ value: name, title }));

/** A place for a part that comes with the first setting that asks for it. */
function laterTray(
  store: Store<MotionState>,
  what: string,
  isDue: (setting: Setting) => boolean,
  create: (tray: HTMLElement) => Promise<void>,
): HTMLElement {
  const tray = element('div');
  const bring = later(store, what, () => create(tray));
  watch(store, ['setting'], ({ setting }) => {
    if (isDue(setting)) void bring();
  });
  return tray;
}

function laterTrays(store: Store<MotionState>, run: MotionRun): HTMLElement[] {
  return [
    laterTray(
      store,
      'What imex saves',
      ({ stepper }) => stepper === 'imex',
      async (tray) => (await import('./imex-panel')).createImexPanel(tray, store, run),
    ),
    laterTray(
      store,
      'The details of the method',
      ({ stepper }) => Object.keys(stepperRow(stepper).details).length > 0,
      async (tray) => (await import('./method-details')).createMethodDetails(tray, store),
    ),
  ];
}

function countFields(store: Store<MotionState>) {
  return COUNTS.map((count) =>
    countField(count, {
      drag(value) {
        const { setting } = store.get();
        const isMoved = value !== setting.substeps;
        if (count === 'substeps') store.set({ draggedSubsteps: isMoved ? value : null });
      },
      choose(value) {
        const setting = { ...store.get().setting, [count]: value };
        store.set({ draggedSubsteps: null, setting });
      },
    }),
  );
}

export function createMethodPanel(
  parent: HTMLElement,
  store: Store<MotionState>,
  run: MotionRun,
): void {
  function change(patch: Partial<Setting>): void {
    store.set({ setting: { ...store.get().setting, ...patch } });
  }

  const model = modelPicker((chosen) =>
    store.set({ setting: withModel(store.get().setting, chosen) }),
  );
  const level = levelPicker((chosen) =>
    store.set({ setting: withLevel(store.get().setting, chosen) }),
  );
  const meshNote = noteLine();
  const stepper = choice(STEPPER_CHOICES, (chosen) =>
    store.set({ setting: withStepper(store.get().setting, chosen) }),
  );
  const stepperNote = noteLine();
  const step = choice(
    STEPS_PER_SECOND.map((count) => ({ value: count, title: `1/${count} s` })),
    (count) => change({ stepS: 1 / count }),
  );
  const counts = countFields(store);
  const builtNote = noteLine();
  const leftNote = noteLine();
  const details = folded('Details', {}, leftNote, builtNote);
  addSection(
    parent,
    'Method',
    model.group,
    level.group,
    meshNote,
    field('Method', stepper.control, stepperNote),
    element('div', { class: 'row' }, field('Step', step.control), ...counts.map((c) => c.box)),
    ...laterTrays(store, run),
    details,
  );

  watch(store, ['setting', 'costs'], ({ setting, costs }) => level.show(setting, costs));
  watch(store, ['setting'], ({ setting }) => {
    const row = stepperRow(setting.stepper);
    model.show(setting);
    stepper.limit((value) => stepperNeed(value, setting));
    stepper.select(setting.stepper);
    step.select(Math.round(1 / setting.stepS));
    const { substeps, iterations } = row.settings;
    const meanings = [row.meaning, substeps?.meaning, iterations?.meaning];
    setText(stepperNote, meanings.filter((meaning) => meaning).join(' '));
    for (const count of counts) count.show(setting);
  });
  watch(store, ['numbers', 'isCutShort'], (state) => setText(leftNote, leftWords(state)));
  watch(store, ['summary'], ({ summary, setting }) => {
    if (!summary) return;
    const { n_vertices, n_triangles, n_springs, n_bends, built, left_out, notes } = summary;
    const isAutomatic = setting.substeps === 0 || wantedShare(setting) > 0;
    const substeps = isAutomatic ? ` One step takes ${summary.substeps} substeps.` : '';
    const bends = n_bends > 0 ? `, ${n_bends} bends` : '';
    const parts = n_springs > 0 ? `${n_springs} springs${bends}` : `${n_triangles} triangles`;
    const halving = hasLevels(setting) ? ' Each level halves the mesh size.' : '';
    setText(meshNote, `${n_vertices} vertices, ${parts}.${halving}${substeps}`);
    const needs = [
      built.length > 0 ? `Built: ${built.join(', ')}.` : '',
      left_out.length > 0
        ? `Left out, as this scene needs none of it: ${left_out.join(', ')}.`
        : '',
      ...(notes ?? []),
      `One step is ${stepTitle(setting.stepS)}.`,
    ];
    setText(builtNote, needs.filter((part) => part !== '').join(' '));
  });
}
