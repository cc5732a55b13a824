import { describe, expect, it } from 'vitest';
import { digits, percent, smallLength, stepTitle } from '../../src/shared/panels/quantity';

describe('quantity', () => {
  it.each([
    [1234.5, '1230'],
    [0.01234, '0.0123'],
    [2.34567, '2.35'],
    [0, '0'],
    [3e-7, '3·10⁻⁷'],
    [8.06e-66, '< 10⁻⁹'],
    [-1e-12, '< 10⁻⁹'],
    [9.999e-5, '1·10⁻⁴'],
    [9.996, '10.0'],
    [Number.NaN, '–'],
    [-0.5, '-0.500'],
  ])('writes %f as %s', (value, text) => {
    expect(digits(value)).toBe(text);
  });

  it('carries the unit that fits the size', () => {
    expect(percent(0.0123)).toBe('1.2 %');
    expect(smallLength(0.0042)).toBe('4.2 mm');
    expect(smallLength(0.0000042)).toBe('4.2 µm');
    expect(stepTitle(1 / 240)).toBe('1/240 s');
  });
});
