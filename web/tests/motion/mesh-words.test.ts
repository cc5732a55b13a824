import { describe, expect, it } from 'vitest';
import type { BenchRow } from '../../src/motion/bindings/sweep-module';
import { floorsOf } from '../../src/motion/panels/speed-error/mesh-floors';
import {
  errorName,
  errorSentence,
  headline,
  meshText,
  methodSentence,
} from '../../src/motion/panels/speed-error/mesh-words';

const row = (level: number, ms: number, mesh_error_m: number | null, patch: object = {}) =>
  ({
    ...{ level, ms_per_frame: ms, mesh_error_m, status: 'ok' },
    reference: { id: 'x', converged: true, description: '', uncertainty_m: 4e-4 },
    ...patch,
  }) as BenchRow;

describe('what a mesh does wrong', () => {
  const rows = [row(0, 0.2, 4e-3), row(0, 0.1, 4e-3), row(1, 0.5, null), row(1, 0.9, null)];

  it('is a line for each level that it is known of, as wide as its rows', () => {
    expect(floorsOf(rows)).toEqual([{ level: 0, mm: 4, ms: [0.1, 0.2] }]);
    expect(floorsOf([row(0, 1, 4e-3, { status: 'refused' })])).toEqual([]);
  });

  it('is the headline, as a bound where it is below what the reference tells', () => {
    expect(headline(rows, 'known')).toBe(
      'One level finer: the error of the mesh falls from 4.0 mm at level 0 to below 1.6 mm at level 1.',
    );
    expect(headline(rows.slice(0, 2), 'known')).toBe('Error of the mesh: 4.0 mm at level 0.');
    expect(headline([], 'known')).toBe('');
  });

  it('is told of every level in order, and not as a fall where it is none', () => {
    const more = [...rows, row(2, 5, 5e-3)];
    expect(headline(more, 'known')).toBe(
      'Level by level: the error of the mesh goes from 4.0 mm at level 0 to below 1.6 mm at level 1, to 5.0 mm at level 2.',
    );
    expect(headline([row(0, 1, null), row(1, 1, null)], 'known')).toMatch(/goes from below 1.6 mm/);
  });

  it('makes errors of levels comparable; else they are the methods’ own', () => {
    expect(headline(rows, 'unshipped')).toMatch(/within one level only/);
    expect(errorName('known')).toBe('Error');
    expect(errorName('unfetched')).toBe('Method’s error');
  });

  it('has no bound where rows are compared with their own meshes', () => {
    expect(meshText(row(1, 1, null), 'unshipped')).toBe('–');
    expect(errorSentence('unshipped', 1)).toMatch(/over 1 s.*not known here/);
    expect(errorSentence('known', 0.4)).toMatch(/over 0.4 s.*finer mesh/);
  });
});

describe('what a finer mesh does not mend', () => {
  const of = (stepper: string, n_substeps: number, level: number, error: number, mesh: number) =>
    row(level, 1, mesh, {
      method: { stepper, step_s: 1 / 60 },
      n_substeps,
      position_error_m: error,
      method_error_m: error,
    });
  const stuck = [of('implicit', 1, 0, 0.078, 4e-3), of('implicit', 1, 1, 0.077, 1e-3)];

  it('is named with its errors from level to level, in the longest steps', () => {
    const shorter = [of('implicit', 4, 0, 0.02, 4e-3), of('implicit', 4, 1, 0.02, 1e-3)];
    const sentence = methodSentence([...shorter, ...stuck], 'known');
    expect(sentence).toMatch(/shorter steps help: Implicit at 1\/60 s 78 → 77 mm[.]$/);
  });

  it.each([
    ['compared with its own mesh', stuck, 'unshipped'],
    ['of one level', stuck.slice(0, 1), 'known'],
    ['as wrong as its mesh', [of('xpbd', 1, 0, 4e-3, 4e-3), of('xpbd', 1, 1, 4e-3, 4e-3)], 'known'],
    ['less wrong on it', [of('xpbd', 1, 0, 0.1, 4e-3), of('xpbd', 1, 1, 0.05, 1e-3)], 'known'],
  ] as const)('is nothing %s', (_, some, meshError) => {
    expect(methodSentence(some, meshError)).toBe('');
  });
});
