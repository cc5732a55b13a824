// Captions of the strips and of two fabrics in motion against runs of both.
import { describe, expect, it } from 'vitest';
import { bendingLength } from '../../src/fabrics/state/bending-length';
import { PAIR_SCENES, PAIR_STEP_S, sceneTextOf } from '../../src/fabrics/state/pair';
import { droopOf, namesByBendingLength, OVERHANG_M } from '../../src/fabrics/state/strips';
import { fabricNamed, fabricsText } from '../../src/shared/fabric/fabric-data';
import { loadFirst } from '../support/built-module';

/** Time in which a strip swings down and up again [s]. */
const SWUNG_S = 0.6;

const FABRICS = ['canvas', 'wool', 'linen', 'poplin', 'silk', 'chiffon'];

describe('two fabrics in motion', { timeout: 60000 }, () => {
  it('let go over an edge: the limper one swings down farther', async () => {
    expect(PAIR_SCENES.strip.caption).toContain('the limper a fabric, the farther');
    const module = await loadFirst();
    const sorted = namesByBendingLength().filter((name) => FABRICS.includes(name));
    expect(sorted).toHaveLength(FABRICS.length);
    const farthest = sorted.map((name) => {
      const run = new module.Simulation(fabricsText);
      expect(JSON.parse(run.load(sceneTextOf('strip', name))).ok).toBe(true);
      let most = 0;
      for (let timeS = 0; timeS < SWUNG_S; timeS += PAIR_STEP_S) {
        run.step(1);
        most = Math.max(most, droopOf(run.exactPositions()));
      }
      run.delete();
      return most;
    });
    farthest.slice(1).forEach((droop, k) => {
      expect(droop, `${sorted[k + 1]} after ${sorted[k]}`).toBeGreaterThan(farthest[k] ?? 99);
    });
  });

  it('have one wind with the same gusts, whatever they are', () => {
    expect(PAIR_SCENES.flag.caption).toMatch(/One wind, with the same gusts/);
    const windOf = (name: string) => JSON.parse(sceneTextOf('flag', name)).world.air.wind;
    expect(windOf('silk')).toEqual(windOf('canvas'));
    expect(windOf('silk').gust_intensity).toBeGreaterThan(0);
  });
});

describe('the words beside the strips', () => {
  it('tell how far a strip reaches', () => {
    expect(OVERHANG_M).toBeCloseTo(0.04, 12);
  });

  it('tell what a factor of 2 in the rigidity is in the bending length: a quarter', () => {
    const wool = fabricNamed('wool');
    const twice = {
      ...wool,
      bend_warp_n_m: { ...wool.bend_warp_n_m, value: 2 * wool.bend_warp_n_m.value },
      bend_hysteresis_2hb_n: {
        ...wool.bend_hysteresis_2hb_n,
        value: 2 * wool.bend_hysteresis_2hb_n.value,
      },
    };
    expect(bendingLength(twice) / bendingLength(wool)).toBeCloseTo(1.25, 1);
  });
});
