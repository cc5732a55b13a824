import { describe, expect, it } from 'vitest';
import { changed } from '../../../bench/parts/assets.mjs';
import { rankCorrelation } from '../../../bench/parts/bench-rows.mjs';
import { crumpledDress } from '../../../bench/parts/crumpled-dress.mjs';
import { distance } from '../../../bench/parts/honesty-order.mjs';
import { isTold } from '../../../bench/parts/honesty-warnings.mjs';

describe('rank correlation', () => {
  const errors = [3, 1, 4, 1.5, 9, 2.6];

  it('is 1 for the same order, -1 for the opposite one, whatever the values', () => {
    expect(rankCorrelation(errors, errors.map(Math.exp))).toBeCloseTo(1, 12);
    expect(
      rankCorrelation(
        errors,
        errors.map((x) => -x),
      ),
    ).toBeCloseTo(-1, 12);
  });

  it('is that of its closed form, 1 - 6 sum d^2 / (n (n^2 - 1))', () => {
    expect(rankCorrelation([1, 2, 3, 4, 5], [2, 1, 3, 5, 4])).toBeCloseTo(1 - (6 * 4) / 120, 12);
  });

  it('counts equal values as one place', () => {
    expect(rankCorrelation([1, 1, 2], [1, 1, 2])).toBeCloseTo(1, 12);
    expect(rankCorrelation([1, 1, 2], [1, 2, 3])).toBeLessThan(1);
  });

  it('is not a number where there is nothing to rank', () => {
    expect(rankCorrelation([1], [2])).toBeNaN();
  });
});

describe('the distance from the truth', () => {
  const sample = (...positions_m) => ({ positions_m });

  it('weighs vertices by mass, and leaves out those of the finer mesh alone', () => {
    const ours = [sample(0, 0, 0, 1, 0, 0)];
    const truth = [sample(0, 3, 0, 1, 0, 4, 7, 7, 7)];
    expect(distance(ours, truth, [1, 1])).toBeCloseTo(Math.sqrt(25 / 2), 12);
    expect(distance(ours, truth, [3, 1])).toBeCloseTo(Math.sqrt((27 + 16) / 4), 12);
  });

  it('is the root of the mean over samples', () => {
    const still = sample(0, 0, 0);
    expect(distance([still, still], [sample(2, 0, 0), still], [5])).toBeCloseTo(Math.SQRT2, 12);
  });
});

describe('the crumpled dress', () => {
  const text = crumpledDress(12, 6, 3);
  const lines = text.split('\n').map((line) => line.split(' '));
  const triangles = lines
    .filter(([key]) => key === 'f')
    .map(([, ...corners]) => corners.map(Number));

  it('has its pieces whole, closed around, and apart', () => {
    expect(lines.filter(([key]) => key === 'v')).toHaveLength(12 * 6 * 3);
    expect(triangles).toHaveLength(2 * 12 * 5 * 3);
    const edges = triangles.flatMap(([a, b, c]) => [`${a} ${b}`, `${b} ${c}`, `${c} ${a}`]);
    expect(new Set(edges).size).toBe(edges.length); // wound alike, at most two at an edge
    const piece = (corner) => Math.floor((corner - 1) / 72);
    for (const corners of triangles) expect(new Set(corners.map(piece)).size).toBe(1);
  });

  it('has slivers, and is the same every time', () => {
    const places = lines.filter(([key]) => key === 'v').map(([, ...xyz]) => xyz.map(Number));
    const length = (a, b) =>
      Math.hypot(...[0, 1, 2].map((k) => places[a - 1][k] - places[b - 1][k]));
    const edges = triangles.flatMap(([a, b, c]) => [length(a, b), length(b, c), length(c, a)]);
    expect(Math.max(...edges) / Math.min(...edges)).toBeGreaterThan(50);
    expect(crumpledDress(12, 6, 3)).toBe(text);
  });
});

describe('warnings that are held to the truth', () => {
  it('changes values of a scene at their pointers, and not the scene', () => {
    const scene = { method: { stepper: 'implicit' }, pins: [{ vertices: [0] }] };
    const result = changed(scene, {
      '/method/stepper': 'xpbd',
      '/world/air/density_kg_per_m3': 1,
      '/pins/0/vertices': [1],
    });
    expect(result).toEqual({
      method: { stepper: 'xpbd' },
      world: { air: { density_kg_per_m3: 1 } },
      pins: [{ vertices: [1] }],
    });
    expect(scene.method.stepper).toBe('implicit');
    expect(scene.pins[0].vertices).toEqual([0]);
  });

  it('counts an explosion as told by a warning and the exit status, and only if it was silent', () => {
    const told = { status: 'ok', warnings: [{ kind: 'stretch' }], exit: 1 };
    expect(isTold(told)).toBe(true);
    expect(isTold({ ...told, status: 'not_converged' })).toBe(true);
    expect(isTold({ ...told, warnings: [] })).toBe(false);
    expect(isTold({ ...told, exit: 0 })).toBe(false);
    expect(isTold({ ...told, status: 'not_finite' })).toBe(false);
  });
});
