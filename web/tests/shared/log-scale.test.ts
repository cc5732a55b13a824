import { describe, expect, it } from 'vitest';
import { logScale } from '../../src/shared/chart/log-scale';

describe('log-scale', () => {
  it('gives equal ratios equal distances', () => {
    const scale = logScale([0.1, 100]);
    expect(scale.part(10) - scale.part(1)).toBeCloseTo(scale.part(1) - scale.part(0.1), 12);
  });

  it('holds every value inside', () => {
    const values = [0.013, 2, 47, 900];
    const scale = logScale(values);
    for (const value of values) {
      expect(scale.part(value)).toBeGreaterThan(0);
      expect(scale.part(value)).toBeLessThan(1);
    }
  });

  it('spans a decade and labels 1, 2 and 5 when the values lie together', () => {
    const scale = logScale([3, 3.1]);
    expect(scale.high / scale.low).toBeCloseTo(10, 9);
    expect(scale.ticks).toEqual([1, 2, 5]);
  });

  it('labels decades only when there are many', () => {
    expect(logScale([0.01, 1000]).ticks).toEqual([0.01, 0.1, 1, 10, 100, 1000]);
  });

  it('leaves out what has no place on a logarithmic axis', () => {
    const scale = logScale([0, -1, Number.NaN, Number.POSITIVE_INFINITY, 4]);
    expect(scale.low).toBeLessThan(4);
    expect(scale.high).toBeGreaterThan(4);
    expect(Number.isFinite(scale.part(4))).toBe(true);
  });

  it('stands on an empty list', () => {
    expect(logScale([]).ticks.length).toBeGreaterThan(0);
  });
});
