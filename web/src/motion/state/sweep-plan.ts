// The plan that one press of the sweep button measures, and how its rows map back to settings.
import {
  type Model,
  STABLE_SUBSTEPS,
  STEPPER_NAMES,
  STEPPERS,
  type StepperRow,
  type Substeps,
} from '../../shared/steppers/steppers';
import type { BenchRow } from '../bindings/sweep-module';
import type { ObjMesh } from './obj-mesh';
import { type Setting, sceneOf } from './setting';

export interface PlannedMethod {
  stepper: string;
  step_s: number;
  substeps?: Substeps;
  iterations?: number;
}

/** Long enough for the cloth to move and fall, short enough to wait for [s]. */
export const DURATION_S = 1;

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
  /** Each level against the exact motion of its own mesh: a finer mesh's takes minutes here. */
  reference: 'same_mesh';
}

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

/** What is measured at one level, of every stepper that takes part there. */
function methodsAt(level: number, model: Model, withSlow: boolean): PlannedMethod[] {
  const isWanted = (row: StepperRow) =>
    !isSlow(row) || (withSlow && level <= (row.finest_sweep_level ?? FINEST_SWEEP));
  const taking = STEPPERS.filter((row) => row.models.includes(model) && isWanted(row));
  return taking.flatMap(({ name, sweep }) =>
    sweep.map((counts) => ({ stepper: name, step_s: STEP_S, ...counts })),
  );
}

/** What a visitor asks a sweep for. */
export interface SweepWish {
  /** Measures levels 0 to this one. */
  finest: number;
  withSlow: boolean;
}

/** Levels 0 to `finest` of the shown scene, each with every method that takes part. */
export function sweepPlan(
  setting: Setting,
  { finest, withSlow }: SweepWish,
  mesh: ObjMesh | null = null,
): SweepPlan {
  const settings: PlannedSetting[] = [];
  for (let level = 0; level <= finest; ++level) {
    for (const method of methodsAt(level, setting.model, withSlow)) {
      settings.push({ '/refinement/level': level, '/method': method });
    }
  }
  return {
    scene: sceneOf(setting, mesh),
    settings,
    duration_s: DURATION_S,
    reference: 'same_mesh',
  };
}

/** True for a run that came to its end: only such a row has a time and an error. */
export function hasFinished(row: BenchRow): boolean {
  return row.status === 'ok' || row.status === 'not_converged';
}

/** The setting a row was measured with; the counts it does not name stay as they are. */
export function settingOfRow(row: BenchRow, present: Setting): Setting {
  const stepper = STEPPER_NAMES.find((known) => known === row.method.stepper) ?? present.stepper;
  const { substeps } = row.method;
  return {
    ...present,
    level: row.level,
    stepper,
    stepS: row.method.step_s,
    substeps: substeps === STABLE_SUBSTEPS ? 0 : (substeps ?? present.substeps),
    iterations: row.method.iterations ?? present.iterations,
  };
}
