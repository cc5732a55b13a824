import { describe, expect, it } from 'vitest';
import { placesOf, sheetScene } from '../../../bench/parts/same-cloth-ball.mjs';
import { groupGoals, overallGoals } from '../../../bench/parts/same-cloth-goals.mjs';
import {
  cantileverScene,
  catenaryParameter,
  catenaryPoint,
  catenarySag,
  chordAngle,
  unstretched,
} from '../../../bench/parts/same-cloth-rest.mjs';
import {
  counts,
  reasons,
  toldOf,
  verdictOf,
  verdictTable,
  worstOf,
} from '../../../bench/parts/same-cloth-runs.mjs';
import { sliverMesh } from '../../../bench/parts/same-cloth-swatch.mjs';
import { beadOnBall, sheetOnBall } from '../../../bench/parts/sliding-sheet.mjs';

describe('a bead on a ball', () => {
  const at = { radius: 0.25, begin: 0.3, mu: 0 };

  it('leaves it where the cosine is two thirds of that at its start', () => {
    const cosine = (2 / 3) * Math.cos(at.begin);
    const height = (seconds) => Math.hypot(...beadOnBall({ ...at, seconds })) - at.radius;
    const on = [...Array(60).keys()].map((k) => k / 100).filter((t) => height(t) < 1e-7);
    const [x, y] = beadOnBall({ ...at, seconds: Math.max(...on) });
    expect(y / Math.hypot(x, y)).toBeGreaterThan(cosine);
    const [x1, y1] = beadOnBall({ ...at, seconds: Math.max(...on) + 0.02 });
    expect(Math.atan2(x1, y1)).toBeGreaterThan(Math.acos(cosine));
  });

  it('has the energy that it fell', () => {
    const h = 1e-3;
    const [a, b, c] = [-h, 0, h].map((d) => beadOnBall({ ...at, seconds: 0.2 + d }));
    const speed = Math.hypot(c[0] - a[0], c[1] - a[1]) / (2 * h);
    const fallen = at.radius * Math.cos(at.begin) - b[1];
    expect(speed ** 2 / 2 / (9.81 * fallen)).toBeCloseTo(1, 3);
  });

  it('stays within the angle of friction', () => {
    const [x] = beadOnBall({ ...at, mu: 0.4, seconds: 1 });
    expect(x).toBe(at.radius * Math.sin(at.begin));
  });
});

describe('our own sheet on a ball', () => {
  const fabric = {
    density: 0.165,
    warp: 600,
    weft: 500,
    shear: 40,
    bendWarp: 1e-5,
    bendWeft: 1e-5,
  };
  const [n, cell] = [2, 2e-3];
  const of = (more) => {
    const begin = 0.3;
    const [s, c] = [Math.sin(begin), Math.cos(begin)];
    const reach = 0.25;
    const positions = Array.from({ length: 9 }, (_, i) => {
      const [a, b] = [cell * ((i % 3) - 1), cell * (Math.floor(i / 3) - 1)];
      return [reach * s + a * c, reach * c - a * s, b];
    });
    return sheetOnBall({
      positions,
      n,
      cell,
      fabric,
      reach,
      mu: 0,
      seconds: 0.3,
      step: 1e-5,
      ...more,
    });
  };

  it.each([0, 0.1])('goes the way of a bead where it is small, mu %s', (mu) => {
    const [x, y] = beadOnBall({ radius: 0.25, begin: 0.3, mu, seconds: 0.3 });
    const found = of({ mu });
    expect(Math.hypot(found[0] - x, found[1] - y)).toBeLessThan(1e-3);
    expect(Math.abs(found[2])).toBeLessThan(1e-9);
  });

  it('falls freely where the ball is out of reach', () => {
    const [, y] = of({ reach: 0.1, seconds: 0.1 });
    expect(0.25 * Math.cos(0.3) - y).toBeCloseTo(9.81 * 0.005, 4);
  });
});

describe('catenaries', () => {
  it('have their length and their sag', () => {
    const a = catenaryParameter(0.8);
    expect(2 * a * Math.sinh(0.4 / a)).toBeCloseTo(1, 12);
    expect(catenarySag(0.8)).toBeCloseTo(0.2654, 4);
    expect(catenaryPoint(0.8, 0.5)[1]).toBeCloseTo(catenarySag(0.8), 12);
    expect(catenaryPoint(0.8, 0)).toEqual([expect.closeTo(0, 9), expect.closeTo(0, 9)]);
    expect(catenaryPoint(0.8, 1)).toEqual([expect.closeTo(0.8, 9), expect.closeTo(0, 9)]);
  });
});

describe('scenes of known cloth', () => {
  it('have strips of whole cells beside the clamp, and their chord', () => {
    const { cloth, pins } = cantileverScene(2, 5e-3);
    expect(cloth.sheet.rows).toBe(21);
    expect(pins[0].vertices).toHaveLength(2 * (cloth.sheet.columns + 1));
    const down = placesOf({
      cloth: { sheet: { ...cloth.sheet, warp_direction: [0, -Math.sin(0.7), Math.cos(0.7)] } },
    });
    expect(chordAngle(down)).toBeCloseTo((180 * 0.7) / Math.PI, 9);
    const shorter = down.map((place) => place.map((x) => 0.9 * x));
    const apart = unstretched(shorter, 5e-3).map((place, i) =>
      Math.hypot(...place.map((x, k) => x - 0.9 * down[0][k] - (down[i][k] - down[0][k]))),
    );
    const across = cloth.sheet.width_m / 10; // columns are as near as they were
    expect(Math.max(...apart)).toBeCloseTo(across, 9);
  });

  it('have a sheet that touches the ball in its middle', () => {
    const places = placesOf(sheetScene(4, 0));
    const far = places.map((place) => Math.hypot(...place));
    expect(far.indexOf(Math.min(...far))).toBe(12);
    expect(Math.min(...far)).toBeGreaterThan(0.25);
  });

  it('have slivers at a border, wound alike, that close the mesh', () => {
    const { positions_m: places, triangles } = sliverMesh();
    const doubleArea = ([a, b, c]) =>
      (places[b][2] - places[a][2]) * (places[c][0] - places[a][0]) -
      (places[b][0] - places[a][0]) * (places[c][2] - places[a][2]);
    const areas = triangles.map(doubleArea);
    expect(Math.min(...areas)).toBeGreaterThan(0);
    expect(Math.min(...areas)).toBeLessThan(1e-7);
    expect(areas.reduce((sum, area) => sum + area) / 2).toBeCloseTo(0.072 ** 2, 12);
    const edges = triangles.flatMap(([a, b, c]) => [`${a} ${b}`, `${b} ${c}`, `${c} ${a}`]);
    expect(new Set(edges).size).toBe(edges.length);
  });
});

describe('verdicts', () => {
  const about = { right: 1, tolerance: 0.1, unit: 'm', case: 'a', of: 'b' };
  const row = (more) => ({
    ...about,
    stepper: 'xpbd',
    verdict: 'ok',
    told: [],
    status: 'ok',
    ...more,
  });

  it('are right within the tolerance, warned where something is told, else wrong', () => {
    expect(verdictOf(1.09, about, [])).toBe('ok');
    expect(verdictOf(1.2, about, ['stretch'])).toBe('warned');
    expect(verdictOf(1.2, about, [])).toBe('WRONG');
    expect(verdictOf(Number.NaN, about, [])).toBe('WRONG');
  });

  it('take for told what says that the result is off', () => {
    expect(toldOf({ status: 'ok', warnings: [{ kind: 'given_up' }] })).toEqual([]);
    expect(toldOf({ status: 'ok', warnings: [{ kind: 'stretch' }] })).toEqual(['stretch']);
    expect(toldOf({ status: 'not_finite', warnings: [] })).toEqual(['not_finite']);
  });

  it('of several rows are that of the worst', () => {
    const rows = [
      row({ value: 1 }),
      row({ value: 1.3, verdict: 'WRONG' }),
      row({ value: 9, verdict: 'warned' }),
    ];
    expect(worstOf(rows).value).toBe(1.3);
    expect(worstOf([row({ value: 1 }), row({ value: 1.05 })]).value).toBe(1.05);
  });

  it('are counted, and tell in the table what was found', () => {
    const rows = [
      row({ value: 1 }),
      row({ value: 2, verdict: 'WRONG', of: 'c' }),
      row({ value: null, verdict: 'left out', status: undefined, of: 'd', reason: 'cost' }),
    ];
    expect(counts(rows, 'xpbd')).toMatchObject({
      ok: 1,
      warned: 0,
      wrong: 1,
      absent: 1,
      share: 0.5,
    });
    expect(verdictTable(rows, ['xpbd', 'pbd'])).toMatch(/\| a: c \| 1 ± 0.1 m \| WRONG 2 +\| - /);
    expect(reasons(rows)).toBe('left out, cost: xpbd 1');
  });

  it('are goals: none wrong without a word, and the shares of right rows', () => {
    const rows = [row({ value: 1 }), row({ value: 2, verdict: 'WRONG' })];
    const lines = overallGoals(rows).map(({ line }) => line);
    expect(lines).toContain('goal silent_wrong_rows 1 at-most 0 short');
    expect(lines).toContain('goal right_rows_share_xpbd 0.5 at-least 0.75 short');
  });

  it('leave out of a goal what was not computed', () => {
    const rows = [
      row({ value: 1.005 }),
      row({ value: null, status: undefined, verdict: 'refused' }),
    ];
    expect(groupGoals('terminal', rows).map(({ line }) => line)).toEqual([
      'goal terminal_speed_off_by_share 0.005 at-most 0.01 ok',
    ]);
  });
});
