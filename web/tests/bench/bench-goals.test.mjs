import { describe, expect, it } from 'vitest';
import { goal, table } from '../../../bench/parts/bench-rows.mjs';

const ok = { status: 'ok' };
const verdict = (value, direction, bound, rows = [ok]) =>
  goal('name', value, direction, bound, rows).line.split(' ').at(-1);

describe('bench goals', () => {
  it('are ok on the right side of the bound, which counts', () => {
    expect(goal('speed', 4.321, 'at-least', 4, [ok]).line).toBe('goal speed 4.32 at-least 4 ok');
    expect(verdict(2, 'at-most', 2)).toBe('ok');
    expect(verdict(2.1, 'at-most', 2)).toBe('short');
    expect(verdict(3.9, 'at-least', 4)).toBe('short');
  });

  it.each([null, undefined, Number.NaN, Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY])(
    'are short when the figure or its bound is %s',
    (missing) => {
      for (const direction of ['at-most', 'at-least']) {
        expect(verdict(missing, direction, 1)).toBe('short');
        expect(verdict(1, direction, missing)).toBe('short');
      }
    },
  );

  it('are short when a run that they come from did not reach its end', () => {
    expect(verdict(1, 'at-most', 2, [ok, { status: 'not_converged' }])).toBe('ok');
    for (const status of ['not_finite', 'not_positive_definite', 'refused', undefined])
      expect(verdict(1, 'at-most', 2, [ok, { status }])).toBe('short');
  });
});

describe('bench tables', () => {
  it('have whole numbers as they are, others with three digits, a dash for what is none', () => {
    const rows = [
      { name: 'fine', n: 16641, ms: 1.23456 },
      { name: 'coarse', n: 81, ms: null },
    ];
    const columns = { mesh: 'name', vertices: 'n', 'ms/frame': 'ms', half: (row) => row.n / 2 };
    expect(table(rows, columns).split('\n')).toEqual([
      '| mesh   | vertices | ms/frame | half |',
      '| ------ | -------- | -------- | ---- |',
      '| fine   | 16641    | 1.23     | 8320 |',
      '| coarse | 81       | -        | 40.5 |',
    ]);
  });
});
