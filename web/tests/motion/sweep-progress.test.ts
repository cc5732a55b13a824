import { describe, expect, it } from 'vitest';
import type { BenchRow } from '../../src/motion/bindings/sweep-module';
import { soFarWords } from '../../src/motion/panels/speed-error/speed-error-view';
import { presetSetting } from '../../src/motion/state/setting';
import { growthOf } from '../../src/motion/state/step-cost';
import { FIRST_ROUND, sweepPlan } from '../../src/motion/state/sweep-plan';
import { progressOf, runsLeftS, tellsTheRest } from '../../src/motion/state/sweep-progress';
import { stepperRow } from '../../src/shared/steppers/steppers';

const plan = sweepPlan(presetSetting('swinging-sheet'), { finest: 1, withSlow: false });
const { settings, repeats } = plan;
const nMethods = settings.length / 2;

/** So many rows, of which each frame takes a millisecond. */
const rowsOf = (count: number, n_runs = 0) =>
  Array.from({ length: count }, () => ({ status: 'ok', ms_per_frame: 1, n_runs })) as BenchRow[];
const report = (nRows: number, estimated_s: number | null) => ({
  rows: rowsOf(nRows),
  estimated_s,
});
const runS = (60 * plan.duration_s) / 1000;

describe('the progress of a sweep', () => {
  it('is not told before each method was measured on some mesh', () => {
    expect(nMethods).toBeGreaterThan(5);
    for (const few of [0, 1, nMethods - 1])
      for (const makes of [true, false]) {
        expect(tellsTheRest(settings, few)).toBe(false);
        expect(progressOf(report(few, 20), plan, makes, 1, 0)).toBeNull();
      }
    expect(progressOf(report(nMethods, null), plan, true, 1, 0)).toBeNull();
    expect(progressOf(report(nMethods, 20), plan, true, 1, 0)).not.toBeNull();
    expect(progressOf(report(nMethods, null), plan, false, 1, 0)).not.toBeNull();
  });

  it('waits for a method that takes part at a finer level alone', () => {
    const [first] = settings;
    if (!first) throw new Error('the plan is empty');
    const late = { ...first, '/method': { ...first['/method'], stepper: 'late' } };
    expect(tellsTheRest([...settings, late], settings.length)).toBe(false);
    expect(tellsTheRest([...settings, late], settings.length + 1)).toBe(true);
  });

  it('has the runs left in it, those on finer meshes as much dearer as their method grows', () => {
    const later = settings.slice(nMethods).map(({ '/method': { stepper, substeps } }) => {
      const growth = growthOf(stepperRow(stepper), substeps);
      return growth * (FIRST_ROUND + repeats);
    });
    const finer = later.reduce((sum, one) => sum + one, 0);
    expect(runsLeftS(plan, rowsOf(nMethods))).toBeCloseTo(runS * (nMethods * repeats + finer), 9);
    expect(runsLeftS(plan, rowsOf(settings.length, repeats))).toBe(0);
    const [first, ...more] = rowsOf(settings.length, repeats);
    const failed = { ...first, status: 'diverged', n_runs: 0 } as BenchRow;
    expect(runsLeftS(plan, [failed, ...more])).toBe(0);
  });

  it('is the share of the time, and leaves the rest of that time', () => {
    const leftS = runsLeftS(plan, rowsOf(nMethods));
    const told = progressOf(report(nMethods, null), plan, false, leftS / 3, 0);
    expect(told?.share).toBeCloseTo(0.25, 12);
    expect(told?.leftS).toBeNull();
    const all = runsLeftS(plan, rowsOf(settings.length));
    const later = progressOf(report(settings.length, null), plan, false, all / 3, 0);
    expect(later?.share).toBeCloseTo(0.25, 12);
    expect(later?.leftS).toBeCloseTo(all, 9);
    const made = progressOf(report(nMethods, 20), plan, true, 5, 0);
    expect(made?.share).toBeCloseTo(0.25, 12);
    expect(made?.leftS).toBeCloseTo(15, 12);
  });

  it('never goes back, and the time left goes with what is shown', () => {
    const told = progressOf(report(nMethods, 40), plan, true, 5, 0.25);
    expect(told?.share).toBe(0.25);
    expect(told?.leftS).toBeCloseTo(15, 12);
  });

  it('is not all of it while some is left, however wrong the estimate was', () => {
    const told = progressOf(report(nMethods, 20), plan, true, 30, 0);
    expect(told?.share).toBeLessThan(1);
    expect(told?.leftS).toBeGreaterThan(0);
  });

  it('is told as what was measured until its share is known', () => {
    const rows = rowsOf(3);
    expect(soFarWords({ phase: 'running', progress: null, rows })).toMatch(/measured so far: 3/);
    expect(soFarWords({ phase: 'running', progress: 0.129, rows })).toContain('12 % of the time');
    expect(soFarWords({ phase: 'done', progress: 1, rows })).toBe('');
  });
});
