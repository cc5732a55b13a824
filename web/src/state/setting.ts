// What is computed: preset, fabric, level, method. The scene text given to the module is made here.
import curtainText from '../../../assets/scenes/curtain.json?raw';
import swingingSheetText from '../../../assets/scenes/swinging_sheet.json?raw';
import tableclothText from '../../../assets/scenes/tablecloth.json?raw';

export type Stepper = 'implicit' | 'explicit' | 'projective' | 'xpbd';
export type PresetId = 'curtain' | 'tablecloth' | 'swinging-sheet';

/** What a scene says for 0 substeps: as many as the stability bound asks for. */
export const STABLE_SUBSTEPS = 'stable';
export type Substeps = number | typeof STABLE_SUBSTEPS;

export interface Setting {
  preset: PresetId;
  /** English name in the fabric file. */
  fabric: string;
  /** Uniform refinement: each level halves the mesh size. */
  level: number;
  stepper: Stepper;
  /** Time that one step advances [s]. */
  stepS: number;
  /** 0: as many as the stability bound asks for. */
  substeps: number;
  iterations: number;
}

interface SceneFile {
  name: string;
  caption: string;
  fabric: { name: string };
  refinement?: { level?: number };
  method: {
    stepper: Stepper;
    step_s: number;
    substeps?: Substeps;
    iterations?: number;
    [detail: string]: unknown;
  };
  duration_s?: number;
  [part: string]: unknown;
}

export interface Preset {
  title: string;
  caption: string;
  scene: SceneFile;
}

export const STEPPERS: readonly Stepper[] = ['implicit', 'projective', 'xpbd', 'explicit'];
export const LEVELS: readonly number[] = [0, 1, 2, 3, 4];
/** Steps offered, as fractions of a second: 1/30 s to 1/960 s. */
export const STEPS_PER_SECOND: readonly number[] = [30, 60, 120, 240, 480, 960];
export const MOST_SUBSTEPS = 100000;
export const MOST_ITERATIONS = 500;

export type Count = 'substeps' | 'iterations';

export interface StepperTraits {
  title: string;
  meaning: string;
  /** The counts the stepper listens to, each with what it starts from. */
  counts: Partial<Record<Count, { start: number; least: number; meaning: string }>>;
}

export const STEPPER_TRAITS: Record<Stepper, StepperTraits> = {
  implicit: {
    title: 'Implicit',
    meaning:
      'Backward Euler: one large sparse system a substep. Stable at large steps, but it damps the motion.',
    counts: {
      substeps: { start: 1, least: 1, meaning: 'More substeps damp less and cost more.' },
    },
  },
  projective: {
    title: 'Projective',
    meaning: 'Gives each spring its length alone, then solves one constant system; and repeats.',
    counts: {
      substeps: { start: 1, least: 1, meaning: 'More substeps damp less.' },
      iterations: { start: 10, least: 1, meaning: 'More rounds come closer to Implicit.' },
    },
  },
  xpbd: {
    title: 'XPBD',
    meaning: 'Moves the two ends of each spring in turn, in many small substeps.',
    counts: {
      substeps: { start: 30, least: 1, meaning: 'More substeps: stiffer and less damped.' },
      iterations: { start: 1, least: 1, meaning: 'Sweeps over all springs in one substep.' },
    },
  },
  explicit: {
    title: 'Explicit',
    meaning: 'Forces give velocities, velocities give positions. Only stable in tiny substeps.',
    counts: {
      substeps: { start: 0, least: 0, meaning: '0: as many as its stability bound asks for.' },
    },
  },
};

export const COUNTS: readonly Count[] = ['substeps', 'iterations'];

function presetFrom(title: string, text: string): Preset {
  const scene = JSON.parse(text) as SceneFile;
  return { title, caption: scene.caption, scene };
}

export const PRESETS: Record<PresetId, Preset> = {
  curtain: presetFrom('Curtain', curtainText),
  tablecloth: presetFrom('Tablecloth on a ball', tableclothText),
  'swinging-sheet': presetFrom('Swinging sheet', swingingSheetText),
};

export const PRESET_IDS = Object.keys(PRESETS) as PresetId[];

/** Both counts of a method, with the stepper's own start where the method says nothing. */
function countsOf(stepper: Stepper, method: { substeps?: Substeps; iterations?: number }) {
  const { counts } = STEPPER_TRAITS[stepper];
  const { substeps } = method;
  return {
    substeps: substeps === STABLE_SUBSTEPS ? 0 : (substeps ?? counts.substeps?.start ?? 1),
    iterations: method.iterations ?? counts.iterations?.start ?? 1,
  };
}

/** The setting a preset is made for. */
export function presetSetting(preset: PresetId): Setting {
  const { fabric, refinement, method } = PRESETS[preset].scene;
  return {
    preset,
    fabric: fabric.name,
    level: refinement?.level ?? 0,
    stepper: method.stepper,
    stepS: method.step_s,
    ...countsOf(method.stepper, method),
  };
}

/** The same setting under another stepper, with that stepper's usual counts. */
export function withStepper(setting: Setting, stepper: Stepper): Setting {
  const own = PRESETS[setting.preset].scene.method;
  return { ...setting, stepper, ...countsOf(stepper, own.stepper === stepper ? own : {}) };
}

/** The `method` part of a scene: only what the stepper listens to, and the preset's fine print. */
export function methodOf(setting: Setting): Record<string, unknown> {
  const own = PRESETS[setting.preset].scene.method;
  const method: Record<string, unknown> = own.stepper === setting.stepper ? { ...own } : {};
  const { counts } = STEPPER_TRAITS[setting.stepper];
  method.stepper = setting.stepper;
  method.step_s = setting.stepS;
  for (const count of COUNTS) if (counts[count]) method[count] = setting[count];
  if (method.substeps === 0) method.substeps = STABLE_SUBSTEPS;
  return method;
}

/** The scene as the module reads it. */
export function sceneOf(setting: Setting): Record<string, unknown> {
  return {
    ...PRESETS[setting.preset].scene,
    fabric: { name: setting.fabric },
    refinement: { level: setting.level },
    method: methodOf(setting),
  };
}

/** True when both settings compute the same thing, whatever an unused count says. */
export function isSameMethod(a: Setting, b: Setting): boolean {
  const { counts } = STEPPER_TRAITS[a.stepper];
  // Steps are fractions of a second that went through text: an ulp apart is the same.
  const isSameStep = Math.abs(a.stepS - b.stepS) < 1e-9;
  return (
    a.stepper === b.stepper &&
    isSameStep &&
    COUNTS.every((count) => !counts[count] || a[count] === b[count])
  );
}
