import { describe, expect, it } from 'vitest';
import { boundWords, dampingWords, refusal } from '../../src/motion/panels/scene/knit-form';
import { remedyFor } from '../../src/motion/run/remedy';
import { canKeepMotion } from '../../src/motion/run/run-content';
import { knitCoordinates, knitPixels } from '../../src/motion/stage/knit-drawing';
import { KNIT_PLACES, type Knit, knitIn, knitText, knitTitle } from '../../src/motion/state/knit';
import { decodeMotionLink, encodeMotionLink } from '../../src/motion/state/motion-link';
import {
  levelsOf,
  modelsOf,
  PRESETS,
  presetSetting,
  type Setting,
  sceneOf,
  withStepper,
} from '../../src/motion/state/setting';
import { withCost } from '../../src/motion/state/step-cost';
import { sweepPlan } from '../../src/motion/state/sweep-plan';
import { NO_SWEEP, rowOfSetting, sweptScene } from '../../src/motion/state/sweep-state';

const wool = presetSetting('wool');
const own = wool.knit as Knit;

function withKnit(patch: Partial<Knit>): Setting & { knit: Knit } {
  return { ...wool, knit: { ...own, ...patch } };
}

function sectionOf(setting: Setting): Record<string, unknown> {
  return (sceneOf(setting).cloth as { knit: Record<string, unknown> }).knit;
}

function linkOf(setting: Setting): string {
  const { link } = decodeMotionLink('#scene=wool');
  return `#${encodeMotionLink({ ...link, setting })}`;
}

describe('knit', () => {
  it('has the numbers of the scene in the units of the form', () => {
    expect(own).toMatchObject({
      columns: 24,
      rows: 24,
      particle_mass_kg: 1,
      'structural/stiffness_n_per_m': 10,
      'shear/stiffness_n_per_m': 4,
      'bending/stiffness_n_per_m': 0.9,
      'bending/damping_n_s_per_m': 0.7,
      dampingPer: 'm',
    });
  });

  it('gives the scene back as it was', () => {
    expect(sceneOf(wool).cloth).toEqual(PRESETS.wool.scene.cloth);
  });

  it('changes the numbers of the scene, and damping by the unit that it is given in', () => {
    const changed = withKnit({ columns: 12, 'shear/stiffness_n_per_m': 0.3, dampingPer: 'mm' });
    expect(sectionOf(changed)).toMatchObject({
      columns: 12,
      rows: 24,
      shear: { stiffness_n_per_m: 300, damping_n_s_per_m: 500 },
      bending: { stiffness_n_per_m: 900, damping_n_s_per_m: 700 },
      origin_m: [-0.5, 0.75, -0.5],
    });
  });

  it('comes through a link', () => {
    const changed = withKnit({ rows: 9, particle_mass_kg: 0.125, dampingPer: 'mm' });
    const { link, problems } = decodeMotionLink(linkOf(changed));
    expect(problems).toEqual([]);
    expect(link.setting).toEqual(changed);
    expect(knitIn(knitText(own))).toEqual(own);
  });

  it.each([
    ['', 'nothing'],
    [knitText(own).replace(/,m$/, ',cm'), 'another unit'],
    [knitText(own).replace('24,24', '24'), 'a number less'],
    [knitText(own).replace('24,24', '24,x'), 'no number'],
    [knitText(own).replace('24,24', '24,129'), 'too many rows'],
  ])('refuses %s: %s', (text) => {
    expect(knitIn(text)).toBeUndefined();
    const { link, problems } = decodeMotionLink(`#scene=wool&knit=${text}`);
    expect(problems).toHaveLength(1);
    expect(link.setting.knit).toEqual(own);
  });

  it('belongs to the wool alone', () => {
    expect(presetSetting('curtain').knit).toBeUndefined();
    expect(decodeMotionLink(`#scene=curtain&knit=${knitText(own)}`).problems).toHaveLength(1);
  });

  it('has springs, no levels, and starts anew when it is another', () => {
    expect(modelsOf('wool')).toEqual(['springs']);
    expect(levelsOf('wool')).toEqual([0]);
    expect(decodeMotionLink('#scene=wool&level=1').problems.join()).toContain('level: expected 0');
    const [a, b] = [wool, withKnit({ rows: 20 })].map((setting) => ({ setting, mesh: null }));
    expect(a && b && canKeepMotion(a, b)).toBe(false);
  });

  it('is swept at its one level, and its rows say nothing of another knit', () => {
    const { settings } = sweepPlan(wool, { finest: 2, withSlow: false });
    expect(new Set(settings.map((one) => one['/refinement/level']))).toEqual(new Set([0]));
    const row = { level: 0, method: { stepper: 'imex', step_s: wool.stepS }, status: 'ok' };
    const sweep = { ...NO_SWEEP, rows: [row] as never, scene: sweptScene(wool, null) };
    const found = (setting: Setting) => rowOfSetting({ sweep, setting, mesh: null });
    expect(found(wool)).toBe(row);
    expect(found(withKnit({ rows: 20 }))).toBeNull();
    expect(Object.keys(withCost(withCost({}, wool, 1), withKnit({ rows: 20 }), 2))).toHaveLength(2);
  });
});

describe('knit-form', () => {
  it('titles each number', () => {
    expect(KNIT_PLACES.map(knitTitle)).toContain('Particle mass');
    expect(KNIT_PLACES.map(knitTitle)).toContain('Structural stiffness');
    expect(KNIT_PLACES.map(knitTitle)).toContain('Lace columns');
    expect(new Set(KNIT_PLACES.map(knitTitle)).size).toBe(KNIT_PLACES.length);
  });

  it('tells both readings of damping apart', () => {
    expect(dampingWords(own)).toContain('structural 0.079, shear 0.13, bending 0.37.');
    expect(dampingWords(own)).toContain('swings before it rests');
    const printed = dampingWords({ ...own, dampingPer: 'mm' });
    expect(printed).toContain('structural 79, shear 130, bending 370.');
    expect(printed).toContain('does not swing');
  });

  it('takes what the scene may have, and refuses what the page cannot show', () => {
    expect(refusal('columns', 128)).toBe('');
    expect(refusal('particle_mass_kg', -1)).toBe('');
    expect(refusal('rows', 500)).toBe('Rows: expected at most 128 on this page, got 500.');
    expect(refusal('particle_mass_kg', Number.NaN)).toBe('Particle mass: expected a number.');
  });

  it('says the bound of explicit steps, and nothing where there is none', () => {
    const summary = { step_s: 1 / 60, substeps: 126000 } as never;
    const explicit = withStepper(wool, 'explicit');
    expect(boundWords({ setting: explicit, summary })).toMatch(/0\.13 µs, so 126000 a step; .*any/);
    expect(boundWords({ setting: wool, summary })).toBe('');
  });

  it('words a refusal of the reader by its field, and offers the number of the preset', () => {
    const failure = {
      ok: false,
      kind: 'input',
      where: '/cloth/knit/structural/stiffness_n_per_m',
      what: 'expected a number > 0.0, got -1000.0',
    } as const;
    const changed = withKnit({ 'structural/stiffness_n_per_m': -1 });
    const help = remedyFor(failure, changed);
    expect(help?.sentence).toBe('Structural stiffness: expected a number > 0.0, got -1000.0 N/m.');
    expect(help?.remedy).toEqual({ title: 'Take 10 N/mm', setting: wool });
    const whole = remedyFor({ ...failure, where: '/cloth/knit/pattern', what: 'none' }, changed);
    expect(whole).toMatchObject({ sentence: 'The knit: none.', remedy: { setting: wool } });
    expect(remedyFor({ ...failure, where: '/world' }, changed)).toBeNull();
    expect(remedyFor(failure, presetSetting('curtain'))).toBeNull();
  });
});

describe('knit-drawing', () => {
  const pixels = knitPixels(own);
  const holesIn = (fromWale: number, toWale: number, { data, width, height } = pixels) => {
    const px = width / Math.min(own.columns, 10);
    let holes = 0;
    for (let row = 0; row < height; ++row)
      for (let column = fromWale * px; column < toWale * px; ++column)
        if (data[4 * (row * width + column) + 3] === 0) holes += 1;
    return holes / ((toWale - fromWale) * px * height);
  };

  it('has holes in lace and none in plain wales', () => {
    expect(holesIn(0, 6)).toBe(0);
    expect(holesIn(6, 10)).toBeGreaterThan(0.15);
    expect(holesIn(6, 10)).toBeLessThan(0.5);
  });

  it('has stitches that are light and dark in plain wales', () => {
    const lights = pixels.data.filter((_, k) => k % 4 === 0 && (k / 4) % pixels.width < 40);
    expect(Math.max(...lights) - Math.min(...lights)).toBeGreaterThan(100);
  });

  it('repeats across its seams', () => {
    const { data, width, height } = pixels;
    const at = (row: number, column: number) => data[4 * (row * width + column)] ?? 0;
    for (let column = 0; column < 100; ++column)
      expect(Math.abs(at(0, column) - at(height - 1, column))).toBeLessThan(90);
  });

  it('is all plain without lace, and all lace without plain wales', () => {
    const plain = knitPixels({ ...own, 'pattern/lace_columns': 0 });
    expect(plain.data.filter((value, k) => k % 4 === 3 && value === 0)).toHaveLength(0);
    const lace = knitPixels({ ...own, 'pattern/plain_columns': 0 });
    expect(lace.width).toBe((4 / 10) * pixels.width);
    expect(lace.data.some((value, k) => k % 4 === 3 && value === 0)).toBe(true);
  });

  it('is no wider than the cloth, however wide its pattern', () => {
    const wide = knitPixels({ ...own, 'pattern/plain_columns': 1e6 });
    expect(wide.width).toBe((24 / 10) * pixels.width);
  });

  it('puts each wale of particles into the middle of its own', () => {
    const coordinates = knitCoordinates({ ...own, columns: 13, rows: 3 });
    expect(coordinates).toHaveLength(2 * 13 * 3);
    expect(coordinates[2 * 12]).toBeCloseTo(12.5 / 10);
    expect(coordinates[2 * 13]).toBeCloseTo(0.5 / 10);
    expect(coordinates[2 * 13 + 1]).toBe(6); // rows are six times as far apart as columns
  });
});
