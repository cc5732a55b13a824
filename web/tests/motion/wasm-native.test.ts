// The same core natively and in WebAssembly: 100 steps of smooth scenes end at the same places.
import { beforeAll, describe, expect, it } from 'vitest';
import type { PleatModule } from '../../src/motion/bindings/pleat-module';
import { fabricsText } from '../../src/shared/fabric/fabric-data';
import { loadModule } from '../support/built-module';
import { nativePositions } from '../support/native-command';

const steps = 100;
const tolerance = 1e-9; // of the largest coordinate: rounding, carried through 100 smooth steps

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

const methods: Record<string, object> = {
  explicit: { stepper: 'explicit', step_s: 0.004, substeps: 'stable' },
  'implicit, CHOLMOD': { stepper: 'implicit', step_s: 0.004, solver: 'cholmod' },
  'implicit, CG to 1e-12': { stepper: 'implicit', step_s: 0.004, solver: 'cg', tolerance: 1e-12 },
  projective: { stepper: 'projective', step_s: 0.004, iterations: 10, solver: 'cholmod' },
};

let module: PleatModule;
beforeAll(async () => {
  module = await loadModule('pleat');
});

function wasmPositions(scene: object): Float64Array {
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

describe('WebAssembly against native', () => {
  for (const [sceneName, scene] of Object.entries(scenes)) {
    for (const [methodName, method] of Object.entries(methods)) {
      it(`${sceneName}: ${methodName} ends ${steps} steps at the same places`, () => {
        const whole = {
          name: sceneName,
          ...scene,
          method,
          duration_s: 0.004 * steps,
          record: { every_s: 0.004 * steps, format: 'binary' },
        };
        const native = nativePositions(whole);
        const moved = wasmPositions(whole);
        expect(relativeDifference(moved, native)).toBeLessThan(tolerance);
      });
    }
  }
});
