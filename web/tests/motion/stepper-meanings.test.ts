// The page's words on each method, and on more substeps and rounds of it, are true of the swinging sheet.
import { describe, expect, it } from 'vitest';
import { ENERGY_NUMBERS } from '../../src/shared/bindings/pleat-module';
import { fabricsText } from '../../src/shared/fabric/fabric-data';
import { stepperRow } from '../../src/shared/steppers/steppers';
import { loadFirst } from '../support/built-module';
import { begin, sceneOf } from '../support/scene-run';

/** Time until the sheet has swung through and up again [s]. */
const SWUNG_S = 1;

/** Time until meshes and methods part by chance [s]. */
const BEFORE_CHANCE_S = 0.3;

const DRIFT = ENERGY_NUMBERS.indexOf('drift');

interface Method {
  stepper: string;
  step_s?: number;
  substeps?: number;
  iterations?: number;
  tolerance?: number;
}

/** The sheet by a method until then: places, largest stretch so far, and what the method added of energy [J]. */
async function swung(method: Method, level = 0, until_s = SWUNG_S) {
  const module = await loadFirst();
  const scene = {
    ...sceneOf('swinging_sheet'),
    refinement: { level },
    method: { step_s: 1 / 60, ...method },
  };
  const { simulation } = begin(module, scene);
  simulation.openLedger();
  let stretch = 0;
  let warnings: { is_nonsense: boolean }[] = [];
  for (let step = 0; step < Math.round(until_s / scene.method.step_s); ++step) {
    expect(simulation.step(1)).toBe(0);
    const numbers = JSON.parse(simulation.numbers());
    stretch = Math.max(stretch, numbers.largest_stretch);
    warnings = numbers.warnings;
  }
  const drift = simulation.energies()[DRIFT] ?? Number.NaN;
  const places = simulation.exactPositions().slice();
  simulation.delete();
  return { places, stretch, drift, isNonsense: warnings.some((one) => one.is_nonsense) };
}

function rmsApart(a: Float64Array, b: Float64Array): number {
  const sum = a.reduce((total, value, k) => total + (value - (b[k] ?? 0)) ** 2, 0);
  return Math.sqrt(sum / (a.length / 3));
}

function expectFalling(values: readonly number[]): void {
  values.slice(1).forEach((value, k) => {
    expect(value, values.join(' ')).toBeLessThan(values[k] ?? Number.NaN);
  });
}

const meaningOf = (name: string) => stepperRow(name).meaning;
const substepsMeaningOf = (name: string) => stepperRow(name).settings.substeps?.meaning;

describe('a method', { timeout: 120000 }, () => {
  it('implicit is safe at long steps, and takes some swing out', async () => {
    expect(meaningOf('implicit')).toMatch(/Safe at long steps, but takes some swing out/);
    const long = await swung({ stepper: 'implicit', step_s: 1 / 30, substeps: 1 });
    expect(long.isNonsense).toBe(false);
    expect((await swung({ stepper: 'implicit', substeps: 1 })).drift).toBeLessThan(0);
  });

  it.each(['implicit', 'newton', 'projective'])(
    '%s damps less in more substeps',
    async (stepper) => {
      expect(substepsMeaningOf(stepper)).toMatch(/More substeps damp less/);
      const losses: number[] = [];
      for (const substeps of [1, 2, 4, 8]) losses.push(-(await swung({ stepper, substeps })).drift);
      expectFalling(losses);
    },
  );

  it('imex damps less than implicit', async () => {
    expect(meaningOf('imex')).toContain('less damping');
    const [ours, theirs] = [
      await swung({ stepper: 'imex', substeps: 16 }),
      await swung({ stepper: 'implicit', substeps: 16 }),
    ];
    expect(Math.abs(ours.drift)).toBeLessThan(Math.abs(theirs.drift));
  });

  it('projective comes closer to implicit by more rounds', async () => {
    expect(stepperRow('projective').settings.iterations?.meaning).toMatch(/closer to Implicit/);
    const exact = { stepper: 'implicit', substeps: 1, tolerance: 1e-8 };
    const { places } = await swung(exact, 0, BEFORE_CHANCE_S);
    const apart: number[] = [];
    for (const iterations of [2, 8, 32, 128]) {
      const run = await swung({ stepper: 'projective', iterations }, 0, BEFORE_CHANCE_S);
      apart.push(rmsApart(run.places, places));
    }
    expectFalling(apart);
  });

  it.each(['xpbd', 'pbd', 'hpbd', 'multigrid'])(
    '%s is stiffer in more substeps',
    async (stepper) => {
      expect(substepsMeaningOf(stepper)).toMatch(/More substeps: stiffer/);
      const stretches: number[] = [];
      for (const substeps of [1, 4, 16])
        stretches.push((await swung({ stepper, substeps }, 1)).stretch);
      expectFalling(stretches);
    },
  );

  it('pbd is soft on fine meshes', async () => {
    expect(meaningOf('pbd')).toContain('Soft on fine meshes');
    const stretches: number[] = [];
    for (const level of [2, 1, 0])
      stretches.push((await swung({ stepper: 'pbd', substeps: 4, iterations: 4 }, level)).stretch);
    expectFalling(stretches);
  });

  it('explicit takes tiny substeps or refuses', async () => {
    expect(meaningOf('explicit')).toContain('Only stable in tiny substeps');
    const module = await loadFirst();
    const scene = { ...sceneOf('swinging_sheet'), refinement: { level: 0 } };
    const simulation = new module.Simulation(fabricsText);
    const method = { stepper: 'explicit', step_s: 1 / 60, substeps: 10 };
    const { ok, what } = JSON.parse(simulation.load(JSON.stringify({ ...scene, method })));
    simulation.delete();
    expect(ok).toBe(false);
    expect(Number(/\((\d+) substeps would do\)/.exec(what)?.[1])).toBeGreaterThan(20);
  });

  it('rk4 is very exact for as many looks at the forces, and slow: all of its substeps are tiny', async () => {
    expect(meaningOf('rk4')).toMatch(/four looks at the forces a substep. Very exact, and slow/);
    const LOOKS = 4;
    const FEW = 800; // the sheet is stable from 775 substeps on
    const placesOf = async (stepper: string, substeps: number) =>
      (await swung({ stepper, substeps }, 0, 0.1)).places;
    const [coarse, fine] = [await placesOf('rk4', FEW), await placesOf('rk4', 2 * FEW)];
    const plain = await placesOf('explicit', LOOKS * FEW);
    expect(rmsApart(coarse, fine)).toBeLessThan(1e-3 * rmsApart(plain, fine));
    await expect(swung({ stepper: 'rk4', substeps: FEW / 4 }, 0)).rejects.toThrow();
  });
});
