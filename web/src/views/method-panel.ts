// How it is computed: level, stepper, step, and the one count that the stepper listens to.
import type { AppState } from '../state/app-state';
import {
  COUNTS,
  type Count,
  LEVELS,
  MOST_ITERATIONS,
  MOST_SUBSTEPS,
  type Setting,
  STEPPER_TRAITS,
  STEPPERS,
  STEPS_PER_SECOND,
  withStepper,
} from '../state/setting';
import { type Store, watch } from '../state/store';
import { choice, element, field, setText } from './element';
import { stepTitle } from './quantity';

function levelPicker(onChoice: (level: number) => void) {
  const inputs = LEVELS.map((level) =>
    element('input', {
      type: 'radio',
      name: 'level',
      value: level,
      'aria-label': `Level ${level}`,
      change: () => onChoice(level),
    }),
  );
  const group = element(
    'fieldset',
    { class: 'field' },
    element('legend', {}, 'Refinement level'),
    element(
      'div',
      { class: 'segments' },
      ...inputs.map((input, level) => element('label', {}, input, element('span', {}, `${level}`))),
    ),
  );
  return {
    group,
    select(level: number) {
      inputs.forEach((input, index) => {
        input.checked = index === level;
      });
    },
  };
}

const COUNT_TITLES: Record<Count, { title: string; most: number }> = {
  substeps: { title: 'Substeps', most: MOST_SUBSTEPS },
  iterations: { title: 'Iterations', most: MOST_ITERATIONS },
};

/** A whole number that is there only for the steppers that listen to it. */
function countField(count: Count, onChoice: (value: number) => void) {
  const { title, most } = COUNT_TITLES[count];
  const input = element('input', {
    type: 'number',
    max: most,
    step: 1,
    inputmode: 'numeric',
    change() {
      const value = Math.round(Number(input.value));
      const chosen = Math.min(most, Math.max(Number(input.min), value || 0));
      input.value = String(chosen);
      onChoice(chosen);
    },
  });
  const box = field(title, input);
  return {
    box,
    show(setting: Setting) {
      const trait = STEPPER_TRAITS[setting.stepper].counts[count];
      box.hidden = !trait;
      if (!trait) return;
      input.min = String(trait.least);
      input.value = String(setting[count]);
      box.title = trait.meaning;
    },
  };
}

export function createMethodPanel(parent: HTMLElement, store: Store<AppState>): () => void {
  function change(patch: Partial<Setting>): void {
    store.set({ setting: { ...store.get().setting, ...patch } });
  }

  const level = levelPicker((chosen) => change({ level: chosen }));
  const meshNote = element('p', { class: 'note' });
  const stepper = choice(
    STEPPERS.map((value) => ({ value, title: STEPPER_TRAITS[value].title })),
    (chosen) => store.set({ setting: withStepper(store.get().setting, chosen) }),
  );
  const stepperNote = element('p', { class: 'note' });
  const step = choice(
    STEPS_PER_SECOND.map((count) => ({ value: count, title: `1/${count} s` })),
    (count) => change({ stepS: 1 / count }),
  );
  const counts = COUNTS.map((count) => countField(count, (value) => change({ [count]: value })));
  const builtNote = element('p', { class: 'note' });
  const builtBox = element(
    'details',
    {},
    element('summary', {}, 'What this scene needs'),
    builtNote,
  );
  parent.append(
    element(
      'section',
      { 'aria-label': 'Method' },
      level.group,
      meshNote,
      field('Stepper', stepper.control, stepperNote),
      element('div', { class: 'row' }, field('Step', step.control), ...counts.map((c) => c.box)),
      builtBox,
    ),
  );

  const stopSetting = watch(store, ['setting'], ({ setting }) => {
    const traits = STEPPER_TRAITS[setting.stepper];
    level.select(setting.level);
    stepper.select(setting.stepper);
    step.select(Math.round(1 / setting.stepS));
    const { substeps, iterations } = traits.counts;
    const meanings = [traits.meaning, substeps?.meaning, iterations?.meaning];
    setText(stepperNote, meanings.filter((meaning) => meaning).join(' '));
    for (const count of counts) count.show(setting);
  });
  const stopSummary = watch(store, ['summary'], ({ summary, setting }) => {
    if (!summary) return;
    const { n_vertices, n_springs, n_bends, built, left_out, notes } = summary;
    const isAutomatic = setting.stepper === 'explicit' && setting.substeps === 0;
    const substeps = isAutomatic ? ` One step takes ${summary.substeps} substeps.` : '';
    setText(
      meshNote,
      `${n_vertices} vertices, ${n_springs} springs, ${n_bends} bends. Each level halves the mesh size.${substeps}`,
    );
    const parts = [
      built.length > 0 ? `Built: ${built.join(', ')}.` : '',
      left_out.length > 0
        ? `Left out, because nothing here asks for it: ${left_out.join(', ')}.`
        : '',
      ...(notes ?? []),
      `One step is ${stepTitle(setting.stepS)}.`,
    ];
    setText(builtNote, parts.filter((part) => part !== '').join(' '));
  });
  return () => {
    stopSetting();
    stopSummary();
  };
}
