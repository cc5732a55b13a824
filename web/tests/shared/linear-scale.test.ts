import { describe, expect, it } from 'vitest';
import { linearScale, spanScale } from '../../src/shared/chart/linear-scale';

describe('linear scales', () => {
  it('reaches from a tick below the values to one above, and passes zero', () => {
    const { ticks, part } = spanScale([-0.37, 0.12]);
    expect(ticks).toEqual([-0.4, -0.3, -0.2, -0.1, 0, 0.1, 0.2]);
    expect(part(-0.4)).toBeCloseTo(0, 12);
    expect(part(0.2)).toBeCloseTo(1, 12);
    expect(part(-0.1)).toBeCloseTo(0.5, 12);
  });

  it('ends at values that are round themselves', () => {
    expect(spanScale([0, 5]).ticks).toEqual([0, 1, 2, 3, 4, 5]);
    expect(spanScale([-0.3, 0]).ticks).toEqual([-0.3, -0.2, -0.1, 0]);
  });

  it('has room for one value alone', () => {
    const { ticks, part } = spanScale([0, 0]);
    expect(ticks.length).toBeGreaterThan(1);
    expect(part(0)).toBe(0);
  });

  it('begins at zero where that is asked for', () => {
    const { ticks, high, part } = linearScale([3, 47]);
    expect([ticks[0], high, part(high)]).toEqual([0, 50, 1]);
    expect(linearScale([]).high).toBe(1);
  });
});
