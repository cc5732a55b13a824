// The choice that a cloth meets itself: in the scene, the link, the costs and sweeps.
import { afterEach, describe, expect, it } from 'vitest';
import { selfContactWords } from '../../src/motion/panels/contact/self-contact';
import { referenceUrl } from '../../src/motion/run/references';
import { backWords } from '../../src/motion/run/run-words';
import { decodeMotionLink, encodeMotionLink } from '../../src/motion/state/motion-link';
import {
  PRESETS,
  presetSetting,
  type Setting,
  sceneOf,
  withLevel,
  withModel,
  withStepper,
} from '../../src/motion/state/setting';
import { stepCostAt, withCost } from '../../src/motion/state/step-cost';
import { NO_SWEEP, rowOfSetting, sweptScene } from '../../src/motion/state/sweep-state';

const curtain = presetSetting('curtain');
const meeting: Setting = { ...curtain, meetsItself: true };
const worldOf = (setting: Setting) => sceneOf(setting).world;

const { link } = decodeMotionLink('');
const roundTrip = (setting: Setting) => {
  const text = encodeMotionLink({ ...link, setting });
  return { text, ...decodeMotionLink(text) };
};

describe('cloth that meets itself', () => {
  it('is said in the scene, beside the solids, and in the link', () => {
    expect(worldOf(curtain)).not.toHaveProperty('self_contact');
    expect(worldOf(meeting)).toMatchObject({ self_contact: true, colliders: expect.any(Array) });
    expect(worldOf({ ...presetSetting('pendulum'), meetsItself: true })).toEqual({
      self_contact: true,
    });
    expect(roundTrip(meeting).link.setting.meetsItself).toBe(true);
    expect(roundTrip(curtain).text).not.toContain('self_contact');
    expect(decodeMotionLink('self_contact=maybe').problems.join()).toMatch(/on or off/);
  });

  it('stays through changes of level, model and method', () => {
    const moved = withStepper(withModel(withLevel(meeting, 1), 'membrane'), 'newton');
    expect(moved.meetsItself).toBe(true);
  });

  describe('in a preset that says so', () => {
    const { scene } = PRESETS.curtain;
    const { world } = scene;
    afterEach(() => {
      scene.world = world;
    });

    it('keeps the numbers of its file, and can be let pass through itself', () => {
      scene.world = { ...world, self_contact: { friction: 0.7 } };
      const own = presetSetting('curtain');
      expect(worldOf(own)).toMatchObject({ self_contact: { friction: 0.7 } });
      expect(roundTrip(own).text).not.toContain('self_contact');
      expect(roundTrip(own).link.setting.meetsItself).toBe(true);
      const passing = { ...own, meetsItself: undefined };
      expect(worldOf(passing)).not.toHaveProperty('self_contact');
      expect(roundTrip(passing).text).toContain('self_contact=off');
      expect(roundTrip(passing).link.setting.meetsItself).toBeUndefined();
    });

    it('is off where the file says false', () => {
      scene.world = { ...world, self_contact: false };
      expect(presetSetting('curtain')).not.toHaveProperty('meetsItself');
      expect(worldOf(meeting)).toMatchObject({ self_contact: true });
    });
  });

  it('is another scene to costs and sweeps', () => {
    const costs = withCost({}, curtain, 12);
    expect(stepCostAt(costs, curtain, 2)?.ms).toBe(12);
    expect(stepCostAt(costs, meeting, 2)).toBeNull();
    const { level, stepper, stepS, substeps, iterations } = curtain;
    const method = { stepper, step_s: stepS, substeps, iterations, tolerance: 0.001 };
    const row = { level, method, status: 'ok', warnings: [] } as never;
    const sweep = { ...NO_SWEEP, rows: [row], scene: sweptScene(curtain, null) };
    const rowOf = (setting: Setting) => rowOfSetting({ sweep, setting, mesh: null });
    expect(rowOf(curtain)).toBe(row);
    expect(rowOf(meeting)).toBeNull();
  });

  it('has not the reference of cloth that passes through itself', () => {
    expect(referenceUrl(curtain)).toMatch(/curtain\.reference/);
    expect(referenceUrl(meeting)).toBeNull();
  });

  it('is told where the page goes back from it', () => {
    expect(backWords(meeting, curtain, true)).toBe(
      'The contact of the cloth with itself is off again, as before, and the cloth is back at its start.',
    );
  });
});

describe('the choice', () => {
  it('says what it does, or that there are no faces to meet', () => {
    const words = (n_triangles: number) => selfContactWords({ summary: { n_triangles } as never });
    expect(words(512)).toMatch(/^Layers rest on each other/);
    expect(words(0)).toMatch(/particles without faces/);
  });
});
