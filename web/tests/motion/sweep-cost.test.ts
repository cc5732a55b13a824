import { describe, expect, it } from 'vitest';
import { expectation } from '../../src/motion/panels/speed-error/sweep-panel';
import { presetSetting, type Setting } from '../../src/motion/state/setting';
import { type StepCosts, withCost } from '../../src/motion/state/step-cost';
import { expectedSweepS } from '../../src/motion/state/sweep-cost';
import { methodsAt, settingOf } from '../../src/motion/state/sweep-plan';

const shown: Setting = { ...presetSetting('curtain'), level: 1 };
const wish = { finest: 1, withSlow: false, ofShown: true };
/** Time before any work. */
const START_S = 1.5;
const measured = withCost({}, shown, 4);

function expected(costs: StepCosts, setting = shown, asked = wish): number {
  const seconds = expectedSweepS(costs, setting, asked);
  if (seconds === null) throw new Error('an expectation was expected');
  return seconds - START_S;
}

describe('what a sweep would take', () => {
  it('is not known before a step was timed', () => {
    expect(expectedSweepS({}, shown, wish)).toBeNull();
    expect(expectedSweepS(measured, { ...shown, preset: 'tablecloth' }, wish)).toBeNull();
  });

  it('is told in words, and how to learn it', () => {
    const say = (costs: StepCosts) => expectation({ costs, setting: shown }, wish);
    expect(say({})).toMatch(/^Play a moment/);
    expect(say(measured)).toMatch(/^About .* s on this device[.]$/);
  });

  it('follows from the shown method, and grows with the levels and with what takes part', () => {
    const seconds = expected(measured);
    expect(seconds).toBeGreaterThan(0);
    expect(expected(withCost({}, shown, 8))).toBeCloseTo(2 * seconds);
    expect(expected(measured, shown, { ...wish, finest: 2 })).toBeGreaterThan(3 * seconds);
    expect(expected(measured, shown, { ...wish, withSlow: true })).toBeGreaterThan(seconds);
  });

  it('is what the planned methods took themselves, where they were measured', () => {
    const methods = [1].flatMap((level) =>
      methodsAt(level, shown.model, false).map((method) => settingOf({ level, method }, shown)),
    );
    const costs = methods.reduce((known, one) => withCost(known, one, 2), measured);
    // Sixty steps, five times and one and a half.
    expect(expected(costs)).toBeCloseTo((methods.length * 60 * 6.5 * 2) / 1000);
  });

  it('is of another scene in proportion to the shown one, over its own time', () => {
    const ofSheet = expected(measured, shown, { ...wish, ofShown: false });
    expect(ofSheet).toBeGreaterThan(0.4 * expected(measured));
    expect(ofSheet).toBeLessThan(0.6 * expected(measured));
  });

  it('has the references in it where none are shipped', () => {
    const silk = { ...shown, fabric: 'silk' };
    expect(expected(measured, silk)).toBeGreaterThan(2 * expected(measured));
    const meeting: Setting = { ...shown, meetsItself: true };
    const costs = withCost({}, meeting, 4);
    expect(expected(costs, meeting)).toBeGreaterThan(2 * expected(measured));
  });

  it('has those of levels in it that are finer than what is shipped', () => {
    const sheet: Setting = { ...presetSetting('swinging-sheet'), level: 1 };
    const shipped = expected(withCost({}, sheet, 4), sheet, { ...wish, finest: 3 });
    const finer = expected(measured, shown, { ...wish, finest: 3 });
    // Costs are of as many steps: the curtain is compared 1 s long, the sheet 0.4 s.
    expect(finer).toBeGreaterThan(1.5 * (shipped / 0.4));
  });
});
