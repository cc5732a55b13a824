// The plan that one press of the sweep button measures, and how its rows map back to settings.
import {
  type Model,
  STABLE_SUBSTEPS,
  STEPPER_NAMES,
  STEPPERS,
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
const DURATION_S = 1;

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
}

/** The methods measured at one level: those of every stepper that takes part there. */
function methodsAt(level: number, model: Model): PlannedMethod[] {
  const taking = STEPPERS.filter(
    ({ models, finest_sweep_level: finest }) =>
      models.includes(model) && level <= (finest ?? Number.POSITIVE_INFINITY),
  );
  return taking.flatMap(({ name, sweep }) =>
    sweep.map((counts) => ({ stepper: name, step_s: STEP_S, ...counts })),
  );
}

/** Levels 0 to `finest` of the shown scene, each with every method that can keep up. */
export function sweepPlan(
  setting: Setting,
  finest: number,
  mesh: ObjMesh | null = null,
): SweepPlan {
  const settings: PlannedSetting[] = [];
  for (let level = 0; level <= finest; ++level) {
    for (const method of methodsAt(level, setting.model)) {
      settings.push({ '/refinement/level': level, '/method': method });
    }
  }
  return { scene: sceneOf(setting, mesh), settings, duration_s: DURATION_S };
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
