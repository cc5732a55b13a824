import { describe, expect, it } from 'vitest';
import { createStepTimer } from '../../src/motion/run/step-timing';

const totals = (steps: number, stepsMs: number, parts: Record<string, number> = {}) => ({
  steps_timed: steps,
  steps_ms: stepsMs,
  parts_ms: parts,
});

describe('step-timing', () => {
  it('answers with the mean cost between two readings, largest part first, the rest last', () => {
    const timer = createStepTimer();
    expect(timer.feed(totals(10, 500, { solve: 300, forces: 100 }))).toBeNull();
    expect(timer.feed(totals(30, 680, { solve: 360, forces: 180 }))).toEqual({
      totalMs: 9,
      parts: [
        { name: 'forces', ms: 4 },
        { name: 'solve', ms: 3 },
        { name: 'other', ms: 2 },
      ],
    });
  });

  it('gives parts that add up to the total, however many there are', () => {
    const timer = createStepTimer();
    timer.feed(totals(0, 0));
    const parts = { convert: 5, forces: 20, assembly: 30, factor: 0, solve: 60, contact: 10 };
    const timing = timer.feed(totals(10, 150, parts));
    expect(timing?.parts.map(({ name }) => name)).toEqual(['solve', 'assembly', 'other']);
    expect(timing?.parts.reduce((sum, { ms }) => sum + ms, 0)).toBeCloseTo(15);
  });

  it('waits until 50 ms of work lie between them', () => {
    const timer = createStepTimer();
    timer.feed(totals(0, 0));
    expect(timer.feed(totals(10, 49))).toBeNull();
    expect(timer.feed(totals(20, 98))?.totalMs).toBeCloseTo(4.9);
  });

  it('starts anew when the totals went back', () => {
    const timer = createStepTimer();
    timer.feed(totals(100, 1000));
    expect(timer.feed(totals(1, 5))).toBeNull();
    expect(timer.feed(totals(11, 105))?.totalMs).toBe(10);
  });
});
