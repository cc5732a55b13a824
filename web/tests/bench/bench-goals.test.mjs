import { describe, expect, it } from 'vitest';
import { goal, measure } from '../../../native-tests/bench/bench-rows.mjs';

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

describe('bench rows', () => {
  const against = {
    reference: { id: 'still' },
    rest_diagonal_m: 1,
    samples: [{ positions_m: [0, 0, 0] }, { positions_m: [0, 0, 0] }],
  };
  const settings = { repeat: 1, times: [0.5, 1], against, masses: [1], tell: () => undefined };
  const run = { ms: [1, 2, 3], rms: [0], largest: [0], status: 'ok', message: '' };
  const rowOf = async (more) => {
    const contestant = { label: 'one', run: async () => ({ ...run, ...more }) };
    return (await measure([contestant], settings))[0];
  };

  it('have no error at a time that the run did not reach, and meet no goal with it', async () => {
    const row = await rowOf({ samples: [[0, 3, 4]], status: 'not_finite' });
    expect(row.position_errors_m['0.5 s']).toBe(5);
    expect(row.position_error_m).toBeNaN();
    expect(JSON.parse(JSON.stringify(row)).position_error_m).toBeNull();
    expect(verdict(row.position_error_m, 'at-most', 1)).toBe('short');
    expect(verdict(1, 'at-most', Math.min(row.position_error_m, 2))).toBe('short');
  });

  it('have no milliseconds when no frame was timed', async () => {
    const row = await rowOf({ samples: [], ms: [] });
    expect(verdict(row.ms_per_frame, 'at-most', 1)).toBe('short');
  });
});
