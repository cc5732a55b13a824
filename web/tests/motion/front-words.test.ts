import { describe, expect, it } from 'vitest';
import type { BenchRow } from '../../src/motion/bindings/sweep-module';
import { frontWords } from '../../src/motion/panels/speed-error/speed-error-view';

describe('the words of the front', () => {
  const row = (patch: object) =>
    ({ status: 'ok', level: 1, position_error_m: 1e-3, ...patch }) as BenchRow;
  const untold = row({ position_error_m: null });
  const nonsense = row({ warnings: [{ is_nonsense: true }] });
  const of = (rows: BenchRow[], meshError: 'known' | 'unshipped' = 'known') =>
    frontWords({ rows, meshError });

  it('leave out what is on no front, and only where there is some', () => {
    expect(of([row({})])).toBe('front: no other mark is both faster and nearer');
    expect(of([row({}), untold])).toMatch(/nearer; empty ones do not count$/);
    expect(of([row({}), nonsense])).toMatch(/nearer; those crossed out do not count$/);
    expect(of([untold, nonsense])).toMatch(/; those crossed out and empty ones do not count$/);
    expect(of([row({}), row({ status: 'diverged', position_error_m: null })])).not.toContain(
      'empty',
    );
  });

  it('are of one level where levels have references of their own', () => {
    const levels = [row({ level: 1 }), row({ level: 2 })];
    expect(of(levels, 'unshipped')).toContain('no other mark of its level is');
    expect(of(levels.slice(1), 'unshipped')).toContain('no other mark is');
    expect(of(levels)).toContain('no other mark is');
  });
});
