import { expect, it } from 'vitest';
import { unbroken } from '../../src/shared/panels/unbroken';

it('ends no line between a number and its unit, and ends it between words', () => {
  const spaces = (sentence: string) => unbroken(sentence).replaceAll('\u00a0', '_');
  expect(spaces('by more than 80 %, like rubber')).toBe('by more than 80_%, like rubber');
  expect(spaces('Thrown at 30 m/s')).toBe('Thrown at 30_m/s');
  expect(spaces('2.0 mm off, 10 µm, 1.5 s on, 21 % of its time')).toBe(
    '2.0_mm off, 10_µm, 1.5_s on, 21_% of its time',
  );
  expect(spaces('4 sweeps of 18 substeps, 3 meshes')).toBe('4 sweeps of 18 substeps, 3 meshes');
});
