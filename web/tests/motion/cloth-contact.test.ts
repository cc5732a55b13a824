// Contact of the cloth with itself in the read-out: what it costs, and how much of the motion it takes.
import { describe, expect, it } from 'vitest';
import { clothContactCost, heldBackWords } from '../../src/motion/panels/numbers/cloth-contact';
import { createStepTimer } from '../../src/motion/run/step-timing';
import type { MotionState } from '../../src/motion/state/motion-state';
import { presetSetting, sceneOf } from '../../src/motion/state/setting';
import type { RunNumbers } from '../../src/shared/bindings/pleat-module';
import { fabricsText } from '../../src/shared/fabric/fabric-data';
import { loadModule } from '../support/built-module';

const contact = {
  n_pairs: 900,
  n_touching: 40,
  n_lists: 12,
  bytes: 200000,
  held_back_share: 0.003,
  rms_motion_lost_m: 2e-5,
  n_blocked_substeps: 0,
};

type Known = Pick<MotionState, 'numbers' | 'timing'>;

const known = (change: object | null, timing: MotionState['timing'] = null) =>
  ({ numbers: change && { cloth_contact: { ...contact, ...change } }, timing }) as Known;

describe('the read-out of contact', () => {
  it('tells the cost of a step and its share once it was measured', () => {
    const timing = { totalMs: 8, parts: [], clothContactMs: 2 };
    expect(clothContactCost(known({}, timing))).toEqual({
      value: '2.0 ms',
      detail: '25 % of a step',
    });
    expect(clothContactCost(known({}))).toEqual({ value: '–', detail: '' });
  });

  it('tells what was held back, and of cloth that passes through itself nothing', () => {
    const words = (change: object | null) => heldBackWords(known(change)).replaceAll('\u00a0', ' ');
    expect(words({})).toBe('Held back: 0.30 % of the vertices, 20 µm a substep.');
    expect(words({ rms_motion_lost_m: 3e-4 })).toContain('0.30 mm a substep');
    expect(words({ held_back_share: 0 })).toBe('Held back: no vertex.');
    expect(words(null)).toBe('');
    expect(heldBackWords({ numbers: {}, timing: null } as Known)).toBe('');
  });

  it('has the cost from the totals of the run, however small a part it is', () => {
    const timer = createStepTimer();
    const totals = (steps: number, parts: Record<string, number>) => ({
      steps_timed: steps,
      steps_ms: 10 * steps,
      parts_ms: parts,
    });
    timer.feed(totals(10, { solve: 60, forces: 30, 'cloth contact': 2 }));
    const timing = timer.feed(totals(20, { solve: 120, forces: 60, 'cloth contact': 6 }));
    expect(timing?.clothContactMs).toBeCloseTo(0.4);
    expect(timing?.parts.map(({ name }) => name)).toEqual(['solve', 'forces', 'other']);
    expect(timer.feed(totals(30, { solve: 180 }))?.clothContactMs).toBeUndefined();
  });
});

describe('the module', () => {
  /** A sheet that is let down on the floor edge first, and falls on itself in folds. */
  const folding = (world: object) => ({
    ...sceneOf(presetSetting('curtain')),
    cloth: {
      sheet: {
        width_m: 0.3,
        height_m: 0.4,
        columns: 9,
        rows: 12,
        origin_m: [-0.15, 0.41, 0],
        warp_direction: [0, -0.995, 0.0998749],
        weft_direction: [1, 0, 0],
      },
    },
    refinement: { level: 0 },
    pins: [],
    world: { colliders: [{ plane: { point_m: [0, 0, 0], normal: [0, 1, 0] } }], ...world },
    method: { stepper: 'implicit', step_s: 1 / 60, substeps: 4 },
  });

  async function numbersOf(world: object): Promise<RunNumbers> {
    const { Simulation } = await loadModule();
    const simulation = new Simulation(fabricsText);
    try {
      expect(JSON.parse(simulation.load(JSON.stringify(folding(world))))).toMatchObject({
        ok: true,
      });
      expect(simulation.step(60)).toBe(0);
      return JSON.parse(simulation.numbers());
    } finally {
      simulation.delete();
    }
  }

  it('gives figures and the time that it takes where the cloth meets itself', async () => {
    const { cloth_contact: figures, parts_ms } = await numbersOf({ self_contact: true });
    expect(Object.keys(figures ?? {}).sort()).toEqual(Object.keys(contact).sort());
    expect(Object.values(figures ?? {}).every(Number.isFinite)).toBe(true);
    expect(figures?.n_touching).toBeGreaterThan(0);
    expect(figures?.n_pairs).toBeGreaterThanOrEqual(figures?.n_touching ?? Number.NaN);
    expect(figures?.held_back_share).toBeLessThan(1);
    expect(parts_ms['cloth contact']).toBeGreaterThan(0);
  });

  it('gives neither where the cloth passes through itself', async () => {
    for (const world of [{}, { self_contact: false }]) {
      const { cloth_contact, parts_ms } = await numbersOf(world);
      expect(cloth_contact).toBeUndefined();
      expect(parts_ms).not.toHaveProperty('cloth contact');
    }
  });
});
