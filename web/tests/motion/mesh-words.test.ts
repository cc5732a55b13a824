import { describe, expect, it } from 'vitest';
import type { BenchRow } from '../../src/motion/bindings/sweep-module';
import { floorsOf } from '../../src/motion/panels/mesh-floors';
import { errorSentence, refinementSentence } from '../../src/motion/panels/mesh-words';
import { meshText } from '../../src/motion/panels/speed-error-table';

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

  it('is told from level to level, as a bound where it is below what the reference tells', () => {
    expect(refinementSentence(rows)).toBe(
      'What the mesh does wrong: 4.0 mm at level 0, < 1.6 mm at level 1.',
    );
    expect(refinementSentence(rows.slice(0, 2))).toBe('');
  });

  it('has no bound where rows are compared with their own meshes', () => {
    expect(meshText(row(1, 1, null), 'unshipped')).toBe('–');
    expect(errorSentence('unshipped', 1)).toMatch(/over 1 s.*not known here/);
    expect(errorSentence('known', 0.4)).toMatch(/over 0.4 s.*finer mesh/);
  });
});
