import { describe, expect, it } from 'vitest';
import { createStepTimer } from '../src/sim/step-timing';

const totals = (steps: number, solveMs: number, forcesMs: number) => ({
  steps_timed: steps,
  parts_ms: { solve: solveMs, forces: forcesMs },
});

describe('step-timing', () => {
  it('answers with the mean cost between two readings, largest part first', () => {
    const timer = createStepTimer();
    expect(timer.feed(totals(10, 300, 100))).toBeNull();
    expect(timer.feed(totals(30, 360, 180))).toEqual({
      totalMs: 7,
      parts: [
        { name: 'forces', ms: 4 },
        { name: 'solve', ms: 3 },
      ],
    });
  });

  it('waits until 50 ms of work lie between them', () => {
    const timer = createStepTimer();
    timer.feed(totals(0, 0, 0));
    expect(timer.feed(totals(10, 30, 19))).toBeNull();
    expect(timer.feed(totals(20, 60, 38))?.totalMs).toBeCloseTo(4.9);
  });

  it('starts anew when the totals went back', () => {
    const timer = createStepTimer();
    timer.feed(totals(100, 1000, 0));
    expect(timer.feed(totals(1, 5, 0))).toBeNull();
    expect(timer.feed(totals(11, 105, 0))?.totalMs).toBe(10);
  });
});
