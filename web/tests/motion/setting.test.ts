import { describe, expect, it } from 'vitest';
import type { BenchRow } from '../../src/motion/bindings/sweep-module';
import { weightText } from '../../src/motion/panels/numbers/numbers-strip';
import {
  isSameMethod,
  modelsOf,
  ownQuantities,
  PRESET_IDS,
  presetSetting,
  type Setting,
  sceneOf,
  sliderCounts,
  withModel,
  withStepper,
} from '../../src/motion/state/setting';
import { settingOf, sweepPlan, sweptSetting } from '../../src/motion/state/sweep-plan';
import { NO_SWEEP, rowOfSetting, settingIn, sweptScene } from '../../src/motion/state/sweep-state';
import { fabricNamed } from '../../src/shared/fabric/fabric-data';
import { quantityReadings } from '../../src/shared/panels/fabric-quantities';
import { STEPPER_NAMES } from '../../src/shared/steppers/steppers';

const start = presetSetting('curtain');

function rowFor(level: number, method: BenchRow['method']): BenchRow {
  return { level, method, status: 'ok' } as BenchRow;
}

describe('setting', () => {
  it('writes only the counts that the stepper listens to', () => {
    const implicit = sceneOf(withStepper(start, 'implicit')).method as Record<string, unknown>;
    const xpbd = sceneOf(withStepper(start, 'xpbd')).method as Record<string, unknown>;
    expect(implicit).not.toHaveProperty('iterations');
    expect(implicit).toHaveProperty('substeps');
    expect(xpbd).toMatchObject({ stepper: 'xpbd', substeps: 40, iterations: 1 });
  });

  it('writes 0 substeps as the word of the scene format', () => {
    const method = sceneOf(withStepper(start, 'explicit')).method;
    expect(method).toMatchObject({ stepper: 'explicit', substeps: 'stable' });
    const row = rowFor(1, { stepper: 'explicit', step_s: 1 / 60, substeps: 'stable' });
    expect(settingOf(row, start).substeps).toBe(0);
  });

  it('asks for a share of explicit springs of imex alone, and only where there is one', () => {
    const half = { ...presetSetting('pendulum'), explicitShare: 0.5 };
    expect(sceneOf(half).method).toMatchObject({ stepper: 'imex', explicit_share: 0.5 });
    expect(sceneOf({ ...half, explicitShare: 0 }).method).not.toHaveProperty('explicit_share');
    const implicit = withStepper(half, 'implicit');
    expect(sceneOf(implicit).method).not.toHaveProperty('explicit_share');
    expect(isSameMethod(half, { ...half, explicitShare: 0 })).toBe(false);
    expect(isSameMethod(implicit, { ...implicit, explicitShare: 0 })).toBe(true);
  });

  it('offers all small counts on a slider, and ever fewer beyond', () => {
    const counts = sliderCounts(0);
    expect(counts.slice(0, 19)).toEqual([...Array(17).keys(), 18, 20]);
    expect(counts.at(-1)).toBe(480);
    for (const [index, count] of counts.slice(10).entries())
      expect(count / (counts[9 + index] ?? 0)).toBeLessThanOrEqual(1.125);
    expect(sliderCounts(1)).toEqual(counts.slice(1));
  });

  it('keeps the fine print of a stepper away from the others', () => {
    for (const preset of PRESET_IDS) {
      const own = presetSetting(preset);
      for (const stepper of STEPPER_NAMES.filter((other) => other !== own.stepper)) {
        const method = sceneOf(withStepper(own, stepper)).method as Record<string, unknown>;
        const known = ['stepper', 'step_s', 'substeps', 'iterations', 'solver'];
        expect(Object.keys(method).filter((key) => !known.includes(key))).toEqual([]);
      }
    }
  });

  it('changes fabric and level of the scene and nothing else', () => {
    const scene = sceneOf({ ...start, fabric: 'silk', level: 4 });
    const before = sceneOf(start);
    expect(scene).toMatchObject({ fabric: { name: 'silk' }, refinement: { level: 4 } });
    expect({ ...scene, fabric: 0, refinement: 0 }).toEqual({ ...before, fabric: 0, refinement: 0 });
  });

  it('keeps what a preset says of its own fabric, and only of that', () => {
    const own = presetSetting('pendulum');
    expect(sceneOf(own).fabric).toHaveProperty('overrides');
    expect(sceneOf({ ...own, fabric: 'silk' }).fabric).toEqual({ name: 'silk' });
  });

  it('shows the numbers that a preset has of its own, and whose they are', () => {
    const own = presetSetting('pendulum');
    const weightOf = (one: Setting) =>
      quantityReadings(fabricNamed(one.fabric), ownQuantities(one)).get('Weight');
    expect(weightOf(own)).toEqual({
      shown: '200 g/m²',
      badge: 'this scene',
      origin: 'Set by this scene; fine cotton has 110 g/m², measured.',
    });
    const { shown, badge } = weightOf({ ...start, fabric: own.fabric }) ?? {};
    expect([shown, badge]).toEqual(['110 g/m²', 'measured']);
    expect(weightText(own)).toBe('weight of scene');
    expect(weightText(start)).toMatch(/^weight (measured|typical|estimated)$/);
  });

  it('tells methods apart by the counts that matter only', () => {
    const implicit = withStepper(start, 'implicit');
    const projective = withStepper(start, 'projective');
    expect(isSameMethod(implicit, { ...implicit, iterations: 99 })).toBe(true);
    expect(isSameMethod(projective, { ...projective, iterations: 99 })).toBe(false);
    expect(isSameMethod(implicit, { ...implicit, stepS: 1 / 240 })).toBe(false);
  });
});

describe('model', () => {
  it('is the one choice of a mesh, and springs first for a sheet', () => {
    expect(modelsOf('obj')).toEqual(['membrane']);
    expect(presetSetting('obj').model).toBe('membrane');
    expect(presetSetting('curtain').model).toBe('springs');
  });

  it('takes a stepper that can run it, and leaves one that can', () => {
    const xpbd = withStepper(start, 'xpbd');
    expect(withModel(xpbd, 'membrane')).toMatchObject({ model: 'membrane', stepper: 'implicit' });
    expect(withModel(withStepper(start, 'rk4'), 'membrane').stepper).toBe('rk4');
    expect(withModel(xpbd, 'springs').stepper).toBe('xpbd');
  });

  it('stands in the scene', () => {
    const scene = sceneOf(withModel(start, 'membrane'));
    expect(scene.model).toEqual({ elasticity: 'membrane' });
  });
});

describe('sweep-plan', () => {
  const sheet = presetSetting('swinging-sheet');
  const settingsOf = (level: number, finest: number, withSlow = true) =>
    sweepPlan(sheet, { finest, withSlow }).settings.filter(
      (one) => one['/refinement/level'] === level,
    );
  const steppersOf = (level: number, withSlow = true) =>
    new Set(settingsOf(level, 3, withSlow).map((one) => one['/method'].stepper));

  it('leaves out what takes most of the time unless it is asked for', () => {
    expect(steppersOf(0)).toContain('explicit');
    expect(steppersOf(0, false)).toEqual(new Set(['implicit', 'projective', 'xpbd', 'multigrid']));
  });

  it('measures every level up to the finest, with every stepper that can keep up', () => {
    expect(settingsOf(3, 3).length).toBeGreaterThan(0);
    expect(settingsOf(4, 3)).toEqual([]);
    const others = ['implicit', 'projective', 'xpbd', 'multigrid'];
    for (const level of [0, 1, 2, 3]) {
      const expected = level <= 1 ? [...others, 'explicit'] : others;
      expect(steppersOf(level)).toEqual(new Set(expected));
    }
  });

  it('measures a membrane with what can run it', () => {
    const { scene, settings } = sweepPlan(withModel(sheet, 'membrane'), {
      finest: 1,
      withSlow: false,
    });
    expect(scene.model).toEqual({ elasticity: 'membrane' });
    expect(settings.map((one) => one['/method'].stepper)).toEqual([
      ...['implicit', 'implicit', 'newton', 'newton'],
      ...['implicit', 'implicit', 'newton', 'newton'],
    ]);
  });

  it('is of the sheet whose errors are all known, or of the shown scene', () => {
    expect(sweptSetting(start, { finest: 1, withSlow: false })).toEqual(sheet);
    expect(sweptSetting(start, { finest: 1, withSlow: false, ofShown: true })).toBe(start);
  });

  it('leaves out the level of the curtain whose nine hooks leave no fold between them', () => {
    const { settings } = sweepPlan(start, { finest: 2, withSlow: true });
    expect(new Set(settings.map((one) => one['/refinement/level']))).toEqual(new Set([1, 2]));
  });

  it('shows a row of another scene as that scene is', () => {
    const row = rowFor(1, { stepper: 'implicit', step_s: 1 / 60, substeps: 1 });
    const silk = { ...start, fabric: 'silk', hold: 'nothing' as const };
    expect(settingIn(sweptScene(sheet, null), row, silk)).toMatchObject({
      preset: 'swinging-sheet',
      fabric: sheet.fabric,
      level: 1,
      stepper: 'implicit',
    });
  });

  it('gives explicit as many substeps as each level asks for', () => {
    const methods = settingsOf(1, 1).map((one) => one['/method']);
    expect(methods.find(({ stepper }) => stepper === 'explicit')?.substeps).toBe('stable');
  });

  it('finds the row of a setting that a row was applied from', () => {
    const rows = sweepPlan(start, { finest: 2, withSlow: true }).settings.map((one) =>
      rowFor(one['/refinement/level'], { ...one['/method'] }),
    );
    const scene = sweptScene(start, null);
    for (const row of rows) {
      const setting = settingOf(row, start);
      expect(rowOfSetting({ sweep: { ...NO_SWEEP, rows, scene }, setting, mesh: null })).toBe(row);
    }
  });

  it('takes no row of another fabric or model, or of a failed run', () => {
    const method = { stepper: 'implicit', step_s: 1 / 60, substeps: 1 };
    const row = rowFor(1, method);
    const setting = settingOf(row, start);
    for (const change of [{ fabric: 'silk' }, { model: 'membrane' as const }]) {
      const scene = { ...sweptScene(start, null), ...change };
      const sweep = { ...NO_SWEEP, rows: [row], scene };
      expect(rowOfSetting({ sweep, setting, mesh: null })).toBeNull();
    }
    const failed = { ...row, status: 'not_positive_definite' };
    const sweep = { ...NO_SWEEP, rows: [failed], scene: sweptScene(start, null) };
    expect(rowOfSetting({ sweep, setting, mesh: null })).toBeNull();
  });
});
