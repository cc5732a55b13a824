import { describe, expect, it } from 'vitest';
import { affordable, createClock } from '../../src/shared/state/clock';

const STEP_S = 1 / 60;

/** A display on which no time passes. */
const STILL = { later() {}, nowMs: () => 0 };

/** Steps taken in `seconds` of a display at `rate` frames a second. */
function stepsAt(rate: number, seconds: number, speed: number): number {
  const clock = createClock(STILL);
  let taken = 0;
  for (let frame = 0; frame < rate * seconds; ++frame) {
    clock.advance(speed / rate);
    taken += clock.take(STEP_S, affordable(0.5));
  }
  return taken;
}

describe('clock', () => {
  it.each([30, 60, 75, 120, 144])('gives 60 steps a second at %i frames a second', (rate) => {
    expect(Math.abs(stepsAt(rate, 10, 1) - 600)).toBeLessThanOrEqual(1);
  });

  it('gives half the steps at half the speed', () => {
    expect(Math.abs(stepsAt(60, 10, 0.5) - 300)).toBeLessThanOrEqual(1);
  });

  it('drops time after a long gap instead of catching up', () => {
    const clock = createClock(STILL);
    clock.advance(30);
    let taken = 0;
    for (let call = 0; call < 1000; ++call) taken += clock.take(STEP_S, affordable(0.1));
    expect(taken).toBeLessThanOrEqual(1800 / 4);
    clock.restart();
    clock.advance(30);
    clock.take(STEP_S, affordable(1000));
    let after = 0;
    for (let call = 0; call < 1000; ++call) after += clock.take(STEP_S, affordable(0.1));
    expect(after).toBeLessThanOrEqual(6);
  });

  it('asks for one step at a time while the cost is unknown or high', () => {
    const clock = createClock(STILL);
    clock.advance(0.09);
    expect(clock.take(STEP_S, affordable(null))).toBe(1);
    expect(clock.take(STEP_S, affordable(500))).toBe(1);
  });

  it('asks for no step before one is due', () => {
    const clock = createClock(STILL);
    clock.advance(0.9 * STEP_S);
    expect(clock.take(STEP_S, affordable(1))).toBe(0);
  });

  it('goes on with each picture until told to stop, in one loop alone', () => {
    const waiting: (() => void)[] = [];
    const clock = createClock({ later: (callback) => waiting.push(callback), nowMs: () => 0 });
    const heard: string[] = [];
    const show = () => {
      for (const callback of waiting.splice(0)) callback();
    };
    clock.start(() => heard.push('first') > 0);
    show();
    clock.start(() => heard.push('second') < 3);
    for (let picture = 0; picture < 5; ++picture) show();
    expect(heard).toEqual(['first', 'second', 'second']);
  });

  it('says that numbers are due once in a while, or always', () => {
    let nowMs = 1000;
    const clock = createClock({ later() {}, nowMs: () => nowMs });
    expect(clock.areNumbersDue(200, false)).toBe(true);
    nowMs += 100;
    expect(clock.areNumbersDue(200, false)).toBe(false);
    expect(clock.areNumbersDue(200, true)).toBe(true);
  });
});
