// Captions of scenes in air, on solids and on springs against runs of these scenes.
import { describe, expect, it } from 'vitest';
import { loadFirst } from '../support/built-module';
import {
  begin,
  isNear,
  mean,
  STEPS_PER_SECOND,
  sceneOf,
  those,
  type Vertex,
} from '../support/scene-run';

type Triple = [number, number, number];

interface World {
  air: { wind: { velocity_m_per_s: Triple; gust_intensity: number } };
  colliders: { sphere?: { centre_m: Triple; radius_m: number } }[];
}

describe('the caption of', { timeout: 120000 }, () => {
  it('the ball: off its middle the sheet drapes over it, and no vertex gets in', async () => {
    const module = await loadFirst();
    expect(sceneOf('ball').caption).toMatch(/off its middle.*No vertex gets into the ball/);
    const { colliders } = sceneOf('ball').world as World;
    const { centre_m: [cx, cy, cz] = [0, 0, 0], radius_m: radius = 0 } = colliders[0]?.sphere ?? {};
    const { rest, at } = begin(module, sceneOf('ball'));
    const middle = [mean(rest.map(({ x }) => x)) - cx, mean(rest.map(({ z }) => z)) - cz];
    expect(Math.hypot(...middle)).toBeGreaterThan(0.2 * radius);
    let deepest = radius;
    let now: Vertex[] = rest;
    for (let step = 1; step <= 3 * STEPS_PER_SECOND; ++step) {
      now = at(step / STEPS_PER_SECOND);
      for (const { x, y, z } of now)
        deepest = Math.min(deepest, Math.hypot(x - cx, y - cy, z - cz));
    }
    // A tenth of a millimetre: positions of lanes are single precision.
    expect(deepest).toBeGreaterThan(radius - 1e-4);
    const isBelow = ({ y }: Vertex) => y < cy;
    for (const side of [
      ({ x }: Vertex) => x > cx,
      ({ x }: Vertex) => x < cx,
      ({ z }: Vertex) => z > cz,
      ({ z }: Vertex) => z < cz,
    ])
      expect(now.filter(side).some(isBelow)).toBe(true);
    expect(now.some(({ y }) => y > cy + radius)).toBe(true);
  });

  it('the wind: 3 m/s in gusts, in which the sheet billows and hardly stretches', async () => {
    const module = await loadFirst();
    expect(sceneOf('wind').caption).toMatch(/Wind of 3 m\/s comes in gusts.*billows and hardly/);
    const { wind } = (sceneOf('wind').world as World).air;
    expect(Math.hypot(...wind.velocity_m_per_s)).toBeCloseTo(3, 1);
    expect(wind.gust_intensity).toBeGreaterThan(0);
    const { simulation, at } = begin(module, sceneOf('wind'));
    const blown: number[] = [];
    for (let time = 1; time <= 6; time += 0.25) {
      blown.push(-mean(at(time).map(({ z }) => z)));
      expect(JSON.parse(simulation.numbers()).largest_stretch).toBeLessThan(0.05);
    }
    expect(mean(blown)).toBeGreaterThan(0.1);
    expect(Math.max(...blown) - Math.min(...blown)).toBeGreaterThan(0.05);
  });

  it('the pendulum: a hundred particles, and shorter steps leave more springs explicit', async () => {
    const module = await loadFirst();
    expect(sceneOf('pendulum_10x10').caption).toMatch(
      /hundred particles.*Shorter steps leave more/,
    );
    const { rest, simulation } = begin(module, sceneOf('pendulum_10x10'));
    expect(rest).toHaveLength(100);
    const shares = [60, 120, 240, 480].map(
      (perSecond) => 1 - JSON.parse(simulation.implicitShare(1 / perSecond, 7, 0)).share,
    );
    shares.slice(1).forEach((share, k) => {
      expect(share).toBeGreaterThanOrEqual(shares[k] ?? 1);
    });
    expect(shares.at(-1)).toBeGreaterThan((shares[0] ?? 1) + 0.05);
  });

  it('the free-fall drape: it falls freely until two corners catch it', async () => {
    const module = await loadFirst();
    const { caption, pins } = sceneOf('free_fall_drape');
    expect(caption).toMatch(/Let go from the horizontal.*until its two corners catch it/);
    expect(pins).toHaveLength(2);
    const { rest, at } = begin(module, sceneOf('free_fall_drape'));
    const far = ({ z }: Vertex) => isNear(z, 0.5);
    const heightOf = (time: number) => mean(those(rest, at(time), far).map(({ y }) => y));
    const ofFreeFall = (time: number) => (1.5 - heightOf(time)) / ((9.81 / 2) * time ** 2);
    expect(Math.abs(ofFreeFall(0.1) - 1)).toBeLessThan(0.2);
    expect(ofFreeFall(0.4)).toBeLessThan(0.7);
    expect(heightOf(4)).toBeGreaterThan(0.3);
  });

  it('the free-fall drape: coarser levels carry a jerk of the corners through the whole sheet', async () => {
    const module = await loadFirst();
    const scene = sceneOf('free_fall_drape');
    expect(scene.caption).toMatch(/jerk is felt in the whole sheet at once: coarser levels carry/);
    const CAUGHT_S = 1;
    const JERK_M = 0.01;
    /** Height of the free edge a step after the corners were caught, which then jump up by so much. */
    const heightOf = (jump: number, method: object) => {
      const motion = {
        kind: 'ease',
        offset_m: [0, jump, 0],
        begin_s: CAUGHT_S,
        end_s: CAUGHT_S + 1 / STEPS_PER_SECOND,
      };
      const pins = ['upper_left', 'upper_right'].map((part) => ({ part, motion }));
      const { rest, simulation, at } = begin(module, { ...scene, pins, method });
      const now = at(CAUGHT_S + 1 / STEPS_PER_SECOND);
      simulation.delete();
      return mean(those(rest, now, ({ z }) => isNear(z, 0.5)).map(({ y }) => y));
    };
    const felt = (method: object) => heightOf(JERK_M, method) - heightOf(0, method);
    expect(felt(scene.method as object)).toBeGreaterThan(JERK_M / 2);
    // One sweep of the same projections, without levels: it goes a few rows far.
    const sweep = { stepper: 'pbd', step_s: 1 / STEPS_PER_SECOND, substeps: 1, iterations: 1 };
    expect(Math.abs(felt(sweep))).toBeLessThan(JERK_M / 1e4);
  });
});
