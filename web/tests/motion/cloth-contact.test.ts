// Contact of the cloth with itself in the read-out: what it costs, and how much of the motion it takes.
import { describe, expect, it } from 'vitest';
import { clothContactCost, heldBackWords } from '../../src/motion/panels/numbers/cloth-contact';
import { createStepTimer } from '../../src/motion/run/step-timing';
import type { MotionState } from '../../src/motion/state/motion-state';

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
