import { describe, expect, it } from 'vitest';
import { presetSetting, withStepper } from '../../src/motion/state/setting';
import { stepCostAt, withCost } from '../../src/motion/state/step-cost';
import { shortTime } from '../../src/shared/panels/quantity';

const setting = presetSetting('curtain');

describe('the cost of a step', () => {
  const costs = withCost({}, setting, 12);

  it('is what was measured at a level, and grows with the vertices at the others', () => {
    const xpbd = { ...withStepper(setting, 'xpbd'), substeps: 30 };
    const measured = withCost({}, xpbd, 12);
    expect(stepCostAt(measured, xpbd, 2)).toEqual({ ms: 12, isMeasured: true, isLeast: false });
    expect(stepCostAt(measured, xpbd, 3)).toEqual({ ms: 48, isMeasured: false, isLeast: false });
    expect(stepCostAt(measured, xpbd, 0)).toMatchObject({ ms: 0.75, isMeasured: false });
  });

  it('grows faster where a system of all vertices is solved, and is a bound two levels on', () => {
    expect(stepCostAt(costs, setting, 3)).toEqual({ ms: 84, isMeasured: false, isLeast: false });
    expect(stepCostAt(costs, setting, 4)).toEqual({ ms: 588, isMeasured: false, isLeast: true });
  });

  it('grows with the substeps as well where they follow the stability bound', () => {
    const explicit = withStepper(setting, 'explicit');
    const measured = withCost({}, explicit, 10);
    expect(stepCostAt(measured, explicit, 3)).toMatchObject({ ms: 160 });
  });

  it('says nothing of another method, and nothing of coarser levels after a step was stopped', () => {
    expect(stepCostAt(costs, withStepper(setting, 'xpbd'), 2)).toBeNull();
    const stopped = withCost({}, { ...setting, level: 4 }, 9000, { isLeast: true });
    expect(stepCostAt(stopped, setting, 4)).toMatchObject({ ms: 9000, isLeast: true });
    expect(stepCostAt(stopped, setting, 3)).toBeNull();
  });

  it('is short to read', () => {
    expect([0.75, 13, 250, 36000, 240000].map((ms) => shortTime(ms))).toEqual([
      '0.75 ms',
      '13 ms',
      '0.3 s',
      '36 s',
      '4.0 min',
    ]);
  });
});
