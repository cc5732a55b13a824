// The plan that one press of the sweep button measures, and how its rows map back to settings.
import {
  type Model,
  numberOf,
  STEPPER_NAMES,
  STEPPERS,
  type StepperRow,
  type Substeps,
} from '../../shared/steppers/steppers';
import type { BenchMethod, BenchRow } from '../bindings/sweep-module';
import type { ObjMesh } from './obj-mesh';
import {
  detailsOf,
  levelsOf,
  type PresetId,
  presetSetting,
  type Setting,
  sceneOf,
} from './setting';

export interface PlannedMethod {
  stepper: string;
  step_s: number;
  substeps?: Substeps;
  iterations?: number;
}

/** Long enough for the cloth to move and fall, short enough to wait for [s]. */
const DURATION_S = 1;

/** Time until meshes move differently: the free end of the sheet whips round, the cloth over the ball folds [s]. */
const BEFORE_CHANCE_S: Partial<Record<PresetId, number>> = {
  'swinging-sheet': 0.4,
  tablecloth: 0.4,
};

/** Time up to which a scene's motion on one mesh can be compared with that on another [s]; 0 where nothing tells. */
export function comparableS({ preset }: Pick<Setting, 'preset'>): number {
  return BEFORE_CHANCE_S[preset] ?? 0;
}

/** Time over which a sweep compares the motion of a scene [s]. */
export function durationS({ preset }: Pick<Setting, 'preset'>): number {
  return BEFORE_CHANCE_S[preset] ?? DURATION_S;
}

/** Timed runs of each setting. */
export const REPEATS = 5;

/** The first round is dearer than a timed one: it looks at the parts of each step and at the energy. */
export const FIRST_ROUND = 1.5;

/** Time that one step of a measured run advances [s]. */
const STEP_S = 1 / 60;

/** Values by their JSON pointers into the scene. */
export interface PlannedSetting {
  '/refinement/level': number;
  '/method': PlannedMethod;
}

export interface SweepPlan {
  scene: Record<string, unknown>;
  settings: PlannedSetting[];
  duration_s: number;
  repeats: number;
  reference: ReferenceKind;
  reference_level?: number;
}

/** The reference of rows: the exact motion on a finer mesh than any of theirs, or on their own. */
export type ReferenceKind = 'converged' | 'same_mesh';

/** Level of the finer mesh: runs on it are shipped, since they take from minutes to hours. */
export const REFERENCE_LEVEL = 3;

/** The finest level of whose own mesh the exact motion is shipped, of a preset as it is. */
export const FINEST_SHIPPED: Partial<Record<PresetId, number>> = {
  curtain: 2,
  tablecloth: 2,
  'swinging-sheet': 3,
};

/** The scene whose exact motion on a finer mesh is shipped: what each mesh does wrong is known of it alone. */
export const KNOWN_PRESET: PresetId = 'swinging-sheet';

/** Coarsest levels that are a setting: nine hooks on the curtain's first nine vertices leave no fold between them. */
const COARSEST: Partial<Record<PresetId, number>> = { curtain: 1 };

/** The finest level that a sweep is offered for. */
export const FINEST_SWEEP = 3;

/** It is too slow for the finest sweeps, and takes most of the time of the others. */
function isSlow({ finest_sweep_level: finest = FINEST_SWEEP }: StepperRow): boolean {
  return finest < FINEST_SWEEP;
}

/** Steppers that take part in a sweep only when they are asked for. */
export function slowSteppers(model: Model): StepperRow[] {
  return STEPPERS.filter((row) => row.models.includes(model) && isSlow(row));
}

/** Methods that are measured at one level, of every stepper that takes part there. */
export function methodsAt(level: number, model: Model, withSlow: boolean): PlannedMethod[] {
  const isWanted = (row: StepperRow) =>
    !isSlow(row) || (withSlow && level <= (row.finest_sweep_level ?? FINEST_SWEEP));
  const taking = STEPPERS.filter((row) => row.models.includes(model) && isWanted(row));
  return taking.flatMap(({ name, sweep }) =>
    sweep.map((counts) => ({ stepper: name, step_s: STEP_S, ...counts })),
  );
}

/** A reference has to be known so many times better than what it judges. */
export const SURER = 4;

/** A visitor's wish for a sweep. */
export interface SweepWish {
  /** Measures the levels up to this one. */
  finest: number;
  withSlow: boolean;
  /** Measures the scene that is shown; else the one of which all errors are known. */
  ofShown?: boolean;
}

/** The setting of which a sweep takes the scene. */
export function sweptSetting(shown: Setting, { ofShown }: SweepWish): Setting {
  return ofShown ? shown : presetSetting(KNOWN_PRESET);
}

/** The levels that a sweep measures of those that the scene has. */
export function sweptLevels({ preset }: Pick<Setting, 'preset'>, { finest }: SweepWish): number[] {
  const coarsest = COARSEST[preset] ?? 0;
  return levelsOf(preset).filter((level) => level >= coarsest && level <= finest);
}

/** The levels of a setting's scene up to `finest`, each with every method that takes part. */
export function sweepPlan(
  setting: Setting,
  wish: SweepWish,
  mesh: ObjMesh | null = null,
  reference: ReferenceKind = 'converged',
): SweepPlan {
  const settings: PlannedSetting[] = [];
  for (const level of sweptLevels(setting, wish)) {
    for (const method of methodsAt(level, setting.model, wish.withSlow)) {
      settings.push({ '/refinement/level': level, '/method': method });
    }
  }
  return {
    scene: sceneOf(setting, mesh),
    settings,
    duration_s: durationS(setting),
    repeats: REPEATS,
    reference,
    ...(reference === 'converged' ? { reference_level: REFERENCE_LEVEL } : {}),
  };
}

/** True for a run that came to its end: only such a row has a time and an error. */
export function hasFinished(row: BenchRow): boolean {
  return row.status === 'ok' || row.status === 'not_converged';
}

/** The setting of a method at a level, as of a row; the counts it does not name stay as they are. */
export function settingOf(
  { level, method }: { level: number; method: Pick<BenchMethod, keyof PlannedMethod> },
  present: Setting,
): Setting {
  const { stepper: name, step_s, substeps, iterations } = method;
  const stepper = STEPPER_NAMES.find((known) => known === name) ?? present.stepper;
  return {
    ...present,
    level,
    stepper,
    details: detailsOf(stepper, { ...method }),
    stepS: step_s,
    substeps: numberOf(substeps ?? present.substeps),
    iterations: iterations ?? present.iterations,
    explicitShare: 0,
  };
}
