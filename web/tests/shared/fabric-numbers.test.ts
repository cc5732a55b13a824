import { describe, expect, it } from 'vitest';
import type { FitAnswer, TermNumbers } from '../../src/fabrics/bindings/deform-module';
import { curveWords, isWide, weightedSteps } from '../../src/fabrics/panels/energy-curve';
import { clampedWords, readMeasure, trustWords } from '../../src/fabrics/panels/own-fabric-form';
import {
  comparedReading,
  paneNumbers,
  paneReading,
  SPIKE,
} from '../../src/fabrics/panels/term-reading';
import { switched } from '../../src/fabrics/panels/term-switches';
import type { PaneState } from '../../src/fabrics/state/deform-state';
import { errorOfMean, measuredRange, perTerm } from '../../src/fabrics/state/fabric-geometry';
import { linearScale } from '../../src/shared/chart/linear-scale';

const ALL = { recovery: true, stretch: true, bending: true };
const of = (recovery: number, stretch: number, bending: number): TermNumbers => ({
  recovery,
  stretch,
  bending,
});

function pane(name: string, weights: TermNumbers, terms: TermNumbers): PaneState {
  const energy =
    weights.recovery * terms.recovery +
    weights.stretch * terms.stretch +
    weights.bending * terms.bending;
  const step = { energy, terms, relative_step: 1e-3, linearised: true };
  return {
    fabric: { kind: 'named', name },
    weights,
    energy,
    terms,
    steps: [
      { ...step, energy: 2 * energy },
      { ...step, linearised: false },
    ],
    status: 'converged',
    updateMs: 3,
    reach: null,
  };
}

describe('linear-scale', () => {
  it.each([
    [[3.2, 1], 4, 5],
    [[0.07], 0.08, 5],
    [[100], 100, 6],
    [[], 1, 6],
    [[Number.NaN, 0], 1, 6],
  ])('puts %j under a round end of %f with %i values', (values, high, n) => {
    const scale = linearScale(values);
    expect(scale.high).toBeCloseTo(high, 12);
    expect(scale.ticks).toHaveLength(n);
    expect(scale.ticks.at(-1)).toBeCloseTo(high, 12);
    expect(scale.part(high / 2)).toBeCloseTo(0.5, 12);
  });
});

describe('energy-curve', () => {
  const shape = pane('silk', of(0.5, 0.3, 0.2), of(10, 20, 30));

  it('draws terms that add up to the energy, and none for a term that is off', () => {
    const last = weightedSteps(shape, ALL).at(-1);
    expect(last?.terms).toEqual({ recovery: 5, stretch: 6, bending: 6 });
    expect(last?.energy).toBeCloseTo(17, 12);
    expect(weightedSteps(shape, { ...ALL, stretch: false })[0]?.terms.stretch).toBe(0);
  });

  it('is logarithmic over decades, whatever vanishes beside the rest', () => {
    expect(isWide([100, 3])).toBe(true);
    expect(isWide([100, 20])).toBe(false);
    expect(isWide([100, 20, 1e-7, 0])).toBe(false);
    expect(isWide([0, 0])).toBe(false);
  });

  it('says where the energy went, in how many steps, and whether that is the least', () => {
    const words = curveWords('silk', weightedSteps(shape, ALL), shape);
    expect(words).toContain('energy 17.0 after 2 steps, from 34.0 after the first');
    expect(words).toContain('matrix (1)');
    expect(words).toContain('Nothing around this shape costs less.');
    expect(curveWords('silk', [], shape)).toBe('No step yet: pull a handle.');
  });
});

describe('term-switches', () => {
  it('switches a term, but never the last one off', () => {
    expect(switched(ALL, 'stretch')).toEqual({ ...ALL, stretch: false });
    const last = { recovery: false, stretch: false, bending: true };
    expect(switched(last, 'bending')).toBeNull();
    expect(switched(last, 'recovery')).toEqual({ ...last, recovery: true });
  });
});

describe('term-reading', () => {
  it('tells little from much by the share of the unweighted terms', () => {
    const canvas = pane('canvas', of(0.23, 0.03, 0.74), of(20, 78, 2));
    const text = paneNumbers(canvas, ALL).join('\n');
    expect(text).toMatch(/Bends little: 2\.0 % .* bending has a weight of 74 %/);
    expect(text).toMatch(/Stretches much: 78 % .* stretch has a weight of 3\.0 %/);
    expect(text).toContain('Moves away from where it lay');
    expect(paneReading(canvas, ALL)).not.toContain(SPIKE);
  });

  it('says in words what a fabric keeps, and what it gives for it', () => {
    const first = (name: string, weights: TermNumbers, counts = ALL) =>
      paneReading(pane(name, weights, of(5, 90, 5)), counts)[0];
    expect(first('silk', of(0.98, 1e-4, 0.02))).toBe(
      'Silk would rather stay where it lay, and will stretch or bend for it.',
    );
    expect(first('linen', of(0.02, 0.25, 0.73))).toBe(
      'Linen would rather keep from bending, and will move away or stretch for it.',
    );
    expect(first('leather', of(0.5, 0.02, 0.48))).toBe(
      'Leather would rather stay where it lay and keep from bending, and will stretch for it.',
    );
    expect(first('polyester', of(0.34, 0.33, 0.33))).toBe(
      'Polyester gives way in all three ways alike.',
    );
    expect(first('silk', of(0.9, 0.05, 0.05), { ...ALL, recovery: false })).toBe(
      'Silk would rather keep its lengths and keep from bending, and will move away for it.',
    );
  });

  it('names the term that most of the energy is', () => {
    const text = paneNumbers(pane('canvas', of(0.5, 0.1, 0.4), of(8, 20, 1)), ALL).join('\n');
    expect(text).toContain('Energy 6.40, a number without unit, 63 % of it recovery.');
  });

  it('explains the spike where neither stretch nor bending weigh much, unless stretch is off', () => {
    const silk = pane('silk', of(0.98, 1e-4, 0.02), of(5, 90, 5));
    expect(paneReading(silk, ALL)).toContain(SPIKE);
    const spandex = pane('spandex', of(0.5, 1e-4, 0.5), of(30, 40, 30));
    expect(paneReading(spandex, ALL)).not.toContain(SPIKE);
    const off = { ...ALL, stretch: false };
    expect(paneReading(silk, off)).not.toContain(SPIKE);
    expect(paneNumbers(silk, off).join('\n')).toContain('stretch is off and costs nothing');
  });

  it('asks for a pull at rest', () => {
    expect(paneReading(pane('silk', of(1, 0, 0), of(0, 0, 0)), ALL)).toEqual([
      'At rest: no term costs anything. Pull a handle.',
    ]);
  });

  it('compares panes only where they clearly differ', () => {
    const canvas = pane('canvas', of(0.2, 0.1, 0.7), of(10, 30, 1));
    const silk = pane('silk', of(0.98, 1e-4, 0.02), of(9, 90, 8));
    const compared = comparedReading([silk, canvas]);
    expect(compared).toHaveLength(2);
    expect(compared.join('\n')).toContain('canvas bends least: 1.0 against 8.0 of silk');
    expect(comparedReading([silk])).toEqual([]);
  });
});

describe('own-fabric-form', () => {
  it.each([
    ['1.05', 1.05],
    ['1,05', 1.05],
    [' 0.9 ', 0.9],
  ])('reads %j as %f', (text, value) => {
    expect(readMeasure('stretch', text)).toBe(value);
  });

  it.each(['', ' ', 'x', '0', '-1', '1e99', 'Infinity', 'NaN', '1.0.1', '102'])(
    'answers %j with one sentence that names the field',
    (text) => {
      expect(readMeasure('bending', text)).toMatch(/^Bending: [^.]+(\.\d[^.]*)*\.$/);
    },
  );

  const own: FitAnswer = {
    weights: of(0.4, 0.2, 0.4),
    normalised: of(0.7, 0.3, 0.7),
    leave_one_out_error: { ...perTerm(errorOfMean), recovery: 0.2 },
    clamped: ['stretch', 'recovery'],
    measured_range: {
      recovery: measuredRange('recovery'),
      stretch: measuredRange('stretch'),
      bending: measuredRange('bending'),
    },
    nearest: 'poplin',
  };

  it('says which end of the range a measurement beyond it counts as', () => {
    const words = clampedWords(own, of(0.9, 1.3, 0.99));
    expect(words).toHaveLength(2);
    expect(words[0]).toMatch(/stretch of 1.300 .* counts as 1.1242\.$/);
    expect(words[1]).toMatch(/recovery of 0.9000 .* counts as 0.9500\.$/);
  });

  it('says where a measurement changes nothing, as the mean is as good', () => {
    const [recovery, stretch] = trustWords(own);
    expect(recovery).toMatch(/by 0.20; the mean of all misses it by 0.33/);
    expect(stretch).toMatch(/by 0.33, no better than the mean/);
  });
});
