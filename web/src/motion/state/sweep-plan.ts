// What one press of the sweep button measures, and how its rows map back to settings.
import type { BenchRow } from '../bindings/sweep-module';
import type { ObjMesh } from './obj-mesh';
import {
  type Model,
  type Setting,
  STABLE_SUBSTEPS,
  STEPPERS,
  type Stepper,
  type Substeps,
  sceneOf,
} from './setting';

export interface PlannedMethod {
  stepper: Stepper;
  step_s: number;
  substeps?: Substeps;
  iterations?: number;
}

/** Long enough for the cloth to move and fall, short enough to wait for [s]. */
const DURATION_S = 1;

/** Two costs for each stepper, so that every level shows which way its knob moves it. */
const SPRING_METHODS: readonly PlannedMethod[] = [
  { stepper: 'implicit', step_s: 1 / 60, substeps: 1 },
  { stepper: 'implicit', step_s: 1 / 60, substeps: 4 },
  { stepper: 'projective', step_s: 1 / 60, substeps: 1, iterations: 5 },
  { stepper: 'projective', step_s: 1 / 60, substeps: 1, iterations: 30 },
  { stepper: 'xpbd', step_s: 1 / 60, substeps: 10, iterations: 1 },
  { stepper: 'xpbd', step_s: 1 / 60, substeps: 60, iterations: 1 },
  { stepper: 'explicit', step_s: 1 / 60, substeps: STABLE_SUBSTEPS },
];

const METHODS: Record<Model, readonly PlannedMethod[]> = {
  springs: SPRING_METHODS,
  membrane: [
    { stepper: 'implicit', step_s: 1 / 60, substeps: 1 },
    { stepper: 'implicit', step_s: 1 / 60, substeps: 4 },
    { stepper: 'newton', step_s: 1 / 60, substeps: 1 },
  ],
};

/**
 * The finest level that explicit is measured at. Each level has four times the vertices and asks
 * for four times the substeps: the six runs of fine cotton take half a minute at level 1, about
 * ten minutes at level 2.
 */
export const FINEST_EXPLICIT = 1;

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

/** Levels 0 to `finest` of the shown scene, each with every method that can keep up. */
export function sweepPlan(
  setting: Setting,
  finest: number,
  mesh: ObjMesh | null = null,
): SweepPlan {
  const settings: PlannedSetting[] = [];
  for (let level = 0; level <= finest; ++level) {
    for (const method of METHODS[setting.model]) {
      if (method.stepper === 'explicit' && level > FINEST_EXPLICIT) continue;
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
  const stepper = STEPPERS.find((known) => known === row.method.stepper) ?? present.stepper;
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
