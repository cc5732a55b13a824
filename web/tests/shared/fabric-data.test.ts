import { describe, expect, it } from 'vitest';
import { misprint } from '../../src/fabrics/panels/fabric-card';
import { TERMS } from '../../src/fabrics/state/deform-state';
import { errorOfMean, geometryOf, measuredRange } from '../../src/fabrics/state/fabric-geometry';
import { fabricNamed, fabrics, inRun } from '../../src/shared/fabric/fabric-data';

describe('fabric-data', () => {
  it.each(fabrics)('gives $name_en weights that add up to one', (fabric) => {
    const { recomputed } = geometryOf(fabric);
    expect(TERMS.reduce((sum, term) => sum + recomputed[term], 0)).toBeCloseTo(1, 12);
  });

  it('recomputes weights from the normalised measures', () => {
    const { recomputed, published, measures } = geometryOf(fabricNamed('leather'));
    expect(recomputed.recovery).toBeCloseTo(1 / 2.0423, 12);
    expect(recomputed.stretch).toBeCloseTo(0.0423 / 2.0423, 12);
    expect(published.stretch).toBeCloseTo(0.02016, 12);
    expect(measures).toEqual({ recovery: 0.9937, stretch: 1.0119, bending: 0.9871 });
  });

  it('has each measured ratio within its range, which two fabrics reach', () => {
    expect(measuredRange('recovery')).toEqual([0.95, 0.9937]);
    expect(measuredRange('stretch')).toEqual([1.0101, 1.1242]);
    expect(measuredRange('bending')).toEqual([0.9871, 0.9998]);
  });

  it('knows how far the mean of the others misses, as leaving each out in turn shows', () => {
    for (const term of TERMS) {
      const values = fabrics.map((fabric) => geometryOf(fabric).normalised[term]);
      const squares = values.map((value, out) => {
        const others = values.filter((_, index) => index !== out);
        return (value - others.reduce((sum, one) => sum + one, 0) / others.length) ** 2;
      });
      const rms = Math.sqrt(squares.reduce((sum, one) => sum + one, 0) / values.length);
      expect(errorOfMean(term)).toBeCloseTo(rms, 12);
    }
  });
});

describe('a quantity in a run', () => {
  it.each(fabrics)(
    'of $name_en has its friction in bending alone, as the core takes it',
    (fabric) => {
      const { derived } = fabric as unknown as { derived: Record<string, number> };
      for (const thread of ['warp', 'weft'] as const) {
        const { value, range } = inRun(fabric, `bend_${thread}_n_m`);
        expect(value / (derived[`static_bend_${thread}_n_m`] ?? 0)).toBeCloseTo(1, 3);
        expect(range[0]).toBeLessThanOrEqual(value);
        expect(range[1]).toBeGreaterThanOrEqual(value);
      }
      expect(inRun(fabric, 'areal_density_kg_per_m2')).toBe(fabric.areal_density_kg_per_m2);
    },
  );

  it('is as well known as the worse of what is added', () => {
    const grades = ['estimated', 'typical', 'measured'];
    for (const fabric of fabrics)
      for (const key of ['bend_warp_n_m', 'bend_weft_n_m'] as const) {
        const parts = [fabric[key], fabric.bend_hysteresis_2hb_n];
        const worst = Math.min(...parts.map(({ confidence }) => grades.indexOf(confidence)));
        expect(inRun(fabric, key).confidence, fabric.name_en).toBe(grades[worst]);
      }
  });
});

describe('fabric-card', () => {
  it('prints weights beside the recomputed ones for seven fabrics with slips', () => {
    const slips = fabrics.filter((fabric) => {
      const { recomputed, published } = geometryOf(fabric);
      return TERMS.some((term) => misprint(recomputed[term], published[term]) !== null);
    });
    expect(slips.map(({ id }) => id)).toEqual([0, 5, 8, 9, 10, 11, 12]);
  });

  it('prints them as the source does', () => {
    const { recomputed, published } = geometryOf(fabricNamed('spandex'));
    expect(misprint(recomputed.stretch, published.stretch)).toBe('0.0015 %');
    expect(misprint(recomputed.recovery, published.recovery)).toBeNull();
  });
});
