// The mark of numbers that nobody measured, on whatever words of a fabric's strip.
import { describe, expect, it } from 'vitest';
import {
  bendingLengthWords,
  droopWords,
  markedQuantity,
} from '../../src/fabrics/panels/marked-words';
import { stripReading, stripsAnswer } from '../../src/fabrics/panels/strips-panel';
import { fabricNamed, fabrics, inRun } from '../../src/shared/fabric/fabric-data';

const isMeasured = (name: string) =>
  (['bend_warp_n_m', 'areal_density_kg_per_m2'] as const).every(
    (key) => inRun(fabricNamed(name), key).confidence === 'measured',
  );

const names = fabrics.map(({ name_en: name }) => name);

describe('the mark of what nobody measured', () => {
  it('is on some fabrics and not on others', () => {
    expect(names.some(isMeasured)).toBe(true);
    expect(names.every(isMeasured)).toBe(false);
  });

  it.each(names)('is on the length, the droop and the reading of %s alike, or on none', (name) => {
    const fabric = fabricNamed(name);
    const mark = isMeasured(name) ? '' : '~';
    const length = bendingLengthWords(fabric);
    const droop = droopWords(fabric, 33.2);
    expect(length).toMatch(new RegExp(`^${mark}\\d+ mm$`));
    expect(droop).toBe(`${mark}33°`);
    const reading = stripReading(name, 33.2);
    for (const words of [length, droop, markedQuantity(fabric, 'bend_warp_n_m')])
      expect(reading).toContain(` ${words}`);
    const droops = Object.fromEntries(names.map((one) => [one, one === name ? 1 : 50]));
    expect(stripsAnswer({ droops })).toContain(`${name} droops least, by ${mark}1°;`);
  });

  it('is on no droop of a strip that is not at rest', () => {
    expect(droopWords(fabricNamed('wool'), undefined)).toBe('');
  });
});
