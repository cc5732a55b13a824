import { describe, expect, it } from 'vitest';
import type { BenchRow } from '../../src/motion/bindings/sweep-module';
import { frontsOf, pointKind } from '../../src/motion/panels/speed-error/speed-error-plot';
import { logScale } from '../../src/shared/chart/log-scale';

const row = (id: string, patch: object = {}) =>
  ({ reference: { id }, position_error_m: 1e-3, ...patch }) as BenchRow;

describe('the chart of speed and error', () => {
  it('has a front for each reference', () => {
    const rows = [row('a'), row('b'), row('a'), row('b'), row('a')];
    expect(frontsOf(rows, [0, 1, 4, 3])).toEqual([
      [0, 4],
      [1, 3],
    ]);
    expect(frontsOf(rows, [])).toEqual([]);
  });

  it('marks a run of nonsense, told or not, and no other warning', () => {
    const warned = (is_nonsense: boolean) => ({ warnings: [{ is_nonsense }] });
    expect(pointKind(row('a', warned(true)))).toBe('point nonsense');
    expect(pointKind(row('a', { ...warned(true), position_error_m: null }))).toBe('point nonsense');
    expect(pointKind(row('a', warned(false)))).toBe('point');
    expect(pointKind(row('a', { position_error_m: null }))).toBe('point untold');
  });

  it('labels 2 and 5 mm on an axis from 1.6 to 250 mm', () => {
    const { ticks } = logScale([1.6, 250]);
    expect(ticks).toEqual([2, 5, 10, 20, 50, 100, 200]);
  });
});
