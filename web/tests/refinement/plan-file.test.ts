import { describe, expect, it } from 'vitest';
import {
  basePatterns,
  faceAt,
  facePatterns,
  faceStory,
  type PlanFile,
  planStory,
} from '../../src/refinement/state/plan-file';

/** Two quads side by side, of which the second was split once. */
const PLAN: PlanFile = {
  format: 'pleat plan 1',
  base_mesh: { vertices: 6, fingerprint: '0000000000000000' },
  examples: [
    {
      name: 'walk',
      centres_per_m: [
        [2, 1],
        [10, 4],
        [20, 9],
      ],
      low_per_m: [0, 0],
      high_per_m: [1, 1],
    },
  ],
  patterns: 3,
  patterns_of_vertices: [
    [0, 2],
    [1, 1],
    [2, 3],
  ],
  detail_demand: 3,
  level_cap: 2,
  vertices: 11,
  curvature_limits_per_m: [5, 20, 60],
  splits: [[1, 7]],
};

// Vertices 0 1 2 / 3 4 5 from the left, then the second face's centre 6 and middles 7 to 10.
const FACES = Int32Array.from(
  [
    [0, 0, -1, 0, 1, 4, 3],
    [2, 1, 1, 1, 7, 6, 10],
  ].flat(),
);
const none = [-1, -1, -1, -1];
const PARENTS = Int32Array.from(
  [
    none,
    none,
    none,
    none,
    none,
    none,
    [1, 2, 5, 4],
    [1, 2, -1, -1],
    none,
    none,
    [1, 4, -1, -1],
  ].flat(),
);

describe('plan-file', () => {
  it('spreads runs over the base vertices', () => {
    expect(basePatterns(PLAN)).toEqual([0, 0, 1, 2, 2, 2]);
  });

  it('gives a face the largest of its corners, means between base vertices', () => {
    // Corners 0 1 4 3 have 0 0 2 2. Corners 1 7 6 10 have 0, 1/2, 5/4 and 1: rounded 1.
    expect(facePatterns(FACES, PARENTS, PLAN)).toEqual([2, 1]);
  });

  it('counts patterns and splits', () => {
    const story = planStory(PLAN);
    expect(story.patterns.map(({ nVertices }) => nVertices)).toEqual([2, 1, 3]);
    expect(story.patterns[1]).toEqual({
      meansPerM: [10],
      deviationsPerM: [4],
      nVertices: 1,
    });
    expect(story).toMatchObject({
      hasLimits: true,
      nSplits: 1,
      nForBalance: 0,
      rule: { kind: 'demand', value: 3 },
    });
    const [walk] = PLAN.examples;
    const two = planStory({
      ...PLAN,
      examples: [walk, { ...walk, name: 'squat' }] as typeof PLAN.examples,
    });
    expect(two.examples).toEqual(['walk', 'squat']);
    expect(two.patterns[1]?.meansPerM).toEqual([10, 10]);
    const budget = planStory({ ...PLAN, detail_demand: undefined, vertex_budget: 900 });
    expect(budget.rule).toEqual({ kind: 'budget', value: 900 });
  });

  it('tells why a face was split, or was not', () => {
    const whole = faceStory(faceAt(FACES, 0), { ...PLAN, detail_demand: 5 });
    expect(whole).toContain('A face of the base mesh, level 0 of 2.');
    expect(whole).toContain('0 + 0 + 2 + 2 = 4, are not more than 5');
    const split = faceStory(faceAt(FACES, 1), PLAN);
    expect(split).toContain(
      'Its parent was split because its corners ask for 7 together, more than 3',
    );
    expect(split).toContain('still ask for is not more than 3');
  });

  it('tells what faces lost, when a plan is by shape', () => {
    const byShape: PlanFile = {
      ...PLAN,
      criterion: 'shape',
      detail_demand: undefined,
      largest_loss_m: 0.002,
      splits: [[1, 0.0041]],
    };
    expect(planStory(byShape).rule).toEqual({ kind: 'demand', value: 2 });
    const story = faceStory(faceAt(FACES, 1), byShape);
    expect(story).toContain('because it lost 4.1 mm');
    expect(story).toContain('no more than 2 mm are lost');
  });

  it('tells balance, budget and the finest level apart', () => {
    const face = faceAt(FACES, 1);
    const balanced = faceStory(face, { ...PLAN, splits: [[1, 2, 'balance']] });
    expect(balanced).toContain('only because a neighbour');
    expect(faceStory(face, { ...PLAN, level_cap: 1 })).toContain('as fine as the fine mesh');
    const budget = { ...PLAN, detail_demand: undefined, vertex_budget: 900 };
    expect(faceStory(face, budget)).toContain('fit into 900 vertices');
  });
});
