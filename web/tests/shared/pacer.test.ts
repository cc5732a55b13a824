import { describe, expect, it } from 'vitest';
import { createPacer } from '../../src/shared/state/pacer';

const STEP_S = 1 / 60;

/** Steps taken in `seconds` of a display at `rate` frames a second. */
function stepsAt(rate: number, seconds: number, speed: number): number {
  const pacer = createPacer();
  let taken = 0;
  for (let frame = 0; frame < rate * seconds; ++frame) {
    pacer.advance(speed / rate);
    taken += pacer.take(STEP_S, 0.5);
  }
  return taken;
}

describe('pacer', () => {
  it.each([30, 60, 75, 120, 144])('gives 60 steps a second at %i frames a second', (rate) => {
    expect(Math.abs(stepsAt(rate, 10, 1) - 600)).toBeLessThanOrEqual(1);
  });

  it('gives half the steps at half the speed', () => {
    expect(Math.abs(stepsAt(60, 10, 0.5) - 300)).toBeLessThanOrEqual(1);
  });

  it('drops time after a long gap instead of catching up', () => {
    const pacer = createPacer();
    pacer.advance(30);
    let taken = 0;
    for (let call = 0; call < 1000; ++call) taken += pacer.take(STEP_S, 0.1);
    expect(taken).toBeLessThanOrEqual(1800 / 4);
    pacer.clear();
    pacer.advance(30);
    pacer.take(STEP_S, 1000);
    let after = 0;
    for (let call = 0; call < 1000; ++call) after += pacer.take(STEP_S, 0.1);
    expect(after).toBeLessThanOrEqual(6);
  });

  it('asks for one step at a time while the cost is unknown or high', () => {
    const pacer = createPacer();
    pacer.advance(0.09);
    expect(pacer.take(STEP_S, null)).toBe(1);
    expect(pacer.take(STEP_S, 500)).toBe(1);
  });

  it('asks for no step before one is due', () => {
    const pacer = createPacer();
    pacer.advance(0.9 * STEP_S);
    expect(pacer.take(STEP_S, 1)).toBe(0);
  });
});
