// The core natively and in WebAssembly: smooth scenes end at the same places.
import { beforeAll, describe, expect, it } from 'vitest';
import type { Constraints, ConvergenceStudy } from '../../src/motion/bindings/convergence-module';
import { comparedMethods, convergenceWish } from '../../src/motion/state/convergence';
import { MODELS, presetSetting } from '../../src/motion/state/setting';
import { ENERGY_NUMBERS, type PleatModule } from '../../src/shared/bindings/pleat-module';
import { fabricsText } from '../../src/shared/fabric/fabric-data';
import { canRun, type Model, STEPPER_NAMES } from '../../src/shared/steppers/steppers';
import { loadFirst, loadModule } from '../support/built-module';
import { nativeConvergence, nativeEnergy, nativePositions } from '../support/native-command';

/** Steps of a run: rk4, in its hundreds of stable substeps, takes seconds for twenty. */
const stepsOf = (stepper: string) => (stepper === 'rk4' ? 20 : 100);
const stepS = 0.004;
const PATIENCE_MS = 60000;

/**
 * Relative to the largest coordinate: rounding, carried through so many smooth steps. xpbd computes in 32 bits, whose
 * rounding is 1e-7.
 */
const SINGLE_PRECISION = ['xpbd', 'pbd', 'hpbd', 'multigrid'];
const toleranceOf = (stepper: string) => (SINGLE_PRECISION.includes(stepper) ? 2e-5 : 1e-9);

const sheet = (warp: number[], cells: number) => ({
  cloth: {
    sheet: {
      width_m: 1,
      height_m: 1,
      columns: cells,
      rows: cells,
      origin_m: [-0.5, 1.5, 0],
      warp_direction: warp,
      weft_direction: [1, 0, 0],
    },
  },
  pins: [{ part: 'upper_edge' }],
});

// Smooth: nothing buckles and nothing comes into contact.
const scenes: Record<string, object> = {
  'spring pendulum': {
    cloth: {
      particles: {
        positions_m: [
          [0, 1, 0],
          [0.6, 1, 0.1],
        ],
        masses_kg: [1, 0.5],
        springs: [{ a: 0, b: 1, stiffness_n_per_m: 40, damping_n_s_per_m: 0.1 }],
      },
    },
    pins: [{ vertices: [0] }],
  },
  'sheet swinging from its edge': { ...sheet([0, -0.8, 0.6], 8), fabric: { name: 'fine cotton' } },
  'sheet stretched by its weight': {
    ...sheet([0, -1, 0], 16),
    fabric: { name: 'spandex' },
    world: { air: {} },
  },
};

/** Every stepper, each with what makes it do the same work in both builds. */
const methods: Record<string, { stepper: string; [detail: string]: unknown }> = {
  'implicit, CHOLMOD': { stepper: 'implicit', solver: 'cholmod' },
  'implicit, CG to 1e-12': { stepper: 'implicit', solver: 'cg', tolerance: 1e-12 },
  'imex, SOR to 1e-12': { stepper: 'imex', solver: 'sor', tolerance: 1e-12 },
  projective: { stepper: 'projective', iterations: 10, solver: 'cholmod' },
  xpbd: { stepper: 'xpbd', substeps: 4, iterations: 2 },
  pbd: { stepper: 'pbd', substeps: 4, iterations: 2 },
  hpbd: { stepper: 'hpbd', substeps: 4, iterations: 2 },
  multigrid: { stepper: 'multigrid', substeps: 4, iterations: 2 },
  explicit: { stepper: 'explicit', substeps: 'stable' },
  rk4: { stepper: 'rk4', substeps: 'stable' },
  newton: { stepper: 'newton' },
};

let module: PleatModule;
beforeAll(async () => {
  module = await loadFirst();
});

function wasmPositions(scene: object, steps: number): Float64Array {
  const simulation = new module.Simulation(fabricsText);
  try {
    expect(JSON.parse(simulation.load(JSON.stringify(scene)))).toMatchObject({ ok: true });
    expect(simulation.step(steps)).toBe(0);
    return Float64Array.from(simulation.exactPositions());
  } finally {
    simulation.delete();
  }
}

function relativeDifference(a: Float64Array, b: Float64Array): number {
  expect(a.length).toBe(b.length);
  let difference = 0;
  let largest = 0;
  a.forEach((value, i) => {
    difference = Math.max(difference, Math.abs(value - (b[i] ?? Number.NaN)));
    largest = Math.max(largest, Math.abs(value));
  });
  return difference / largest;
}

/** The command's names of the numbers. */
const NATIVE_NAMES = {
  kinetic: 'kinetic_j',
  elastic: 'elastic_j',
  damping: 'work_of_damping_j',
  air: 'work_of_air_j',
  contact: 'work_of_contact_j',
  pins: 'work_of_pins_j',
  tears: 'work_of_tears_j',
  drift: 'drift_j',
} as const;

/** The scene with its model, for the models that it can have: particles have springs alone. */
function modelled(scene: object): [Model, object][] {
  const models: Model[] = 'fabric' in scene ? ['springs', 'membrane'] : ['springs'];
  return models.map((model) => [
    model,
    'fabric' in scene ? { ...scene, model: { elasticity: model } } : scene,
  ]);
}

const runs = Object.entries(scenes).flatMap(([sceneName, scene]) =>
  modelled(scene).flatMap(([model, whole]) =>
    Object.entries(methods)
      .filter(([, { stepper }]) => canRun(stepper, model))
      .map(([methodName, method]) => ({ sceneName, model, methodName, scene: whole, method })),
  ),
);

/** Both null, or within the rounding of a solve in 32 bits. */
function expectNear(value: number | null, other: number | null): void {
  if (value === null || other === null) return expect(value).toBe(other);
  expect(Math.abs(value - other)).toBeLessThan(1e-3 * Math.abs(other) + 1e-6);
}

describe('WebAssembly against native', () => {
  it('is held for every stepper and every model of the page', () => {
    const held = (model: Model) =>
      new Set(runs.filter((run) => run.model === model).map(({ method }) => method.stepper));
    for (const model of MODELS)
      expect(held(model)).toEqual(new Set(STEPPER_NAMES.filter((name) => canRun(name, model))));
  });

  it.each(runs)(
    '$sceneName, $model: $methodName ends at the same places',
    ({ sceneName, scene, method }) => {
      const steps = stepsOf(method.stepper);
      const whole = {
        name: sceneName,
        ...scene,
        method: { step_s: stepS, ...method },
        duration_s: stepS * steps,
        record: { every_s: stepS * steps, format: 'binary' },
      };
      const native = nativePositions(whole);
      const moved = wasmPositions(whole, steps);
      expect(relativeDifference(moved, native)).toBeLessThan(toleranceOf(method.stepper));
    },
    PATIENCE_MS,
  );

  it('accounts for the same energy', () => {
    const particle = {
      name: 'a particle on a spring, pulled about and rubbing on the floor',
      ...scenes['spring pendulum'],
      pins: [{ vertices: [0], motion: { kind: 'move', offset_m: [0.2, 0, 0], end_s: 0.4 } }],
      world: { colliders: [{ plane: { point_m: [0, 0.8, 0] }, friction: 0.3 }] },
      method: { stepper: 'implicit', step_s: stepS },
      duration_s: 100 * stepS,
    };
    const native = nativeEnergy(particle);
    const simulation = new module.Simulation(fabricsText);
    simulation.openLedger();
    expect(JSON.parse(simulation.load(JSON.stringify(particle)))).toMatchObject({ ok: true });
    expect(simulation.step(100)).toBe(0);
    const energies = simulation.energies().slice();
    simulation.delete();
    const largest = Math.max(...Object.values(NATIVE_NAMES).map((name) => native[name] ?? 0));
    for (const [name, nativeName] of Object.entries(NATIVE_NAMES)) {
      const value = energies[ENERGY_NUMBERS.indexOf(name as keyof typeof NATIVE_NAMES)];
      if (name !== 'air' && name !== 'tears')
        expect(Math.abs(native[nativeName] ?? 0)).toBeGreaterThan(0);
      expect((value ?? Number.NaN) / largest).toBeCloseTo((native[nativeName] ?? 0) / largest, 9);
    }
  });

  it.each<Constraints>(['rigid', 'compliant'])(
    'compares methods on one step alike: %s',
    async (constraints) => {
      const scene = { name: 'sheet', ...scenes['sheet swinging from its edge'], duration_s: 1 };
      const methods = comparedMethods(presetSetting('curtain'), constraints).map(({ method }) => ({
        title: '',
        isOwn: false,
        method: { stepper: method.stepper },
      }));
      const wish = {
        ...convergenceWish(methods, constraints, 0.25),
        most_rounds: 65,
        longest_solve_s: 100,
        repeat: 1,
      };
      const names = methods.map(({ method }) => method.stepper).join();
      const words = ['--methods', names, '--constraints', constraints];
      const native = nativeConvergence(scene, [...words, '--at', '0.25', '--rounds', '65']);
      const { studyConvergence } = await loadModule();
      const told: number[] = [];
      const answer = JSON.parse(
        studyConvergence(fabricsText, JSON.stringify(scene), JSON.stringify(wish), (done) =>
          told.push(done),
        ),
      );
      expect(answer).toMatchObject({ ok: true });
      expect(told.at(-1)).toBe(1);
      expect(told).toEqual(told.toSorted((a, b) => a - b));
      const study: ConvergenceStudy = answer.study;
      expect(study.time_s).toBeCloseTo(0.25, 12);
      study.series.forEach(({ method, points }, index) => {
        const other = native.series[index];
        expect(other?.method).toEqual(method);
        expect(points.map(({ rounds }) => rounds)).toEqual(
          other?.points.map(({ rounds }) => rounds),
        );
        points.forEach((point, at) => {
          expect(point.ms).toBeGreaterThan(0);
          for (const key of ['relative_error', 'relative_distance'] as const)
            expectNear(point[key], other?.points[at]?.[key] ?? null);
        });
      });
    },
    PATIENCE_MS,
  );
});
