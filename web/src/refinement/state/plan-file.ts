// The file of a refinement plan, as docs/methods/multiresolution.md describes it, and what can be read
// from it in words.

/**
 * A face that was split: itself, what its corners demanded together or, by shape, what it lost [m],
 * and why else.
 */
export type PlanSplit = [face: number, demand: number] | [number, number, 'balance'];

export interface PlanFile {
  format: 'pleat plan 1';
  base_mesh: { vertices: number; fingerprint: string };
  examples: {
    name: string;
    /** Mean and deviation of each pattern. */
    centres_per_m: [number, number][];
    low_per_m: [number, number];
    high_per_m: [number, number];
  }[];
  patterns: number;
  patterns_of_vertices: [pattern: number, count: number][];
  /** The rule of the plan; curvature where there is none. */
  criterion?: 'shape' | 'curvature';
  largest_loss_m?: number;
  detail_demand?: number;
  vertex_budget?: number;
  level_cap: number;
  vertices: number;
  /** Loss of each face that is not split; none where they were not measured. */
  curvature_limits_per_m: number[];
  splits: PlanSplit[];
}

/** Seven numbers a face, as the module lists them. */
const NUMBERS_PER_FACE = 7;

export interface Face {
  id: number;
  level: number;
  /** -1 for a face of the base mesh. */
  parent: number;
  corners: number[];
}

export function faceAt(faces: Int32Array, index: number): Face {
  const [id = -1, level = 0, parent = -1, ...corners] = faces.subarray(
    NUMBERS_PER_FACE * index,
    NUMBERS_PER_FACE * (index + 1),
  );
  return { id, level, parent, corners };
}

export function countFaces(faces: Int32Array): number {
  return faces.length / NUMBERS_PER_FACE;
}

/** The pattern of each base vertex. */
export function basePatterns(plan: PlanFile): number[] {
  return plan.patterns_of_vertices.flatMap(([pattern, count]) => Array(count).fill(pattern));
}

/**
 * The pattern of each face of any refinement: base vertices' patterns are continued as means, and the
 * largest at a face's corners, rounded, counts.
 */
export function facePatterns(faces: Int32Array, parents: Int32Array, plan: PlanFile): number[] {
  const base = basePatterns(plan);
  const nVertices = parents.length / 4;
  const at = new Float64Array(nVertices);
  for (let vertex = 0; vertex < nVertices; ++vertex) {
    const own = [...parents.subarray(4 * vertex, 4 * vertex + 4)].filter((parent) => parent >= 0);
    const sum = own.reduce((total, parent) => total + (at[parent] ?? 0), 0);
    at[vertex] = own.length > 0 ? sum / own.length : (base[vertex] ?? 0);
  }
  return Array.from({ length: countFaces(faces) }, (_, index) =>
    Math.round(Math.max(...faceAt(faces, index).corners.map((vertex) => at[vertex] ?? 0))),
  );
}

export interface PatternStory {
  /** Mean and deviation of curvature over each example [1/m]. */
  meansPerM: number[];
  deviationsPerM: number[];
  /** Base vertices. */
  nVertices: number;
}

export interface PlanStory {
  examples: string[];
  patterns: PatternStory[];
  nVertices: number;
  /** True when it knows how much the examples bent each face. */
  hasLimits: boolean;
  nSplits: number;
  nForBalance: number;
  isByShape: boolean;
  /** The demand by shape is a length [mm]. */
  rule: { kind: 'demand' | 'budget'; value: number };
}

export function planStory(plan: PlanFile): PlanStory {
  const counts = Array<number>(plan.patterns).fill(0);
  for (const [pattern, count] of plan.patterns_of_vertices)
    counts[pattern] = (counts[pattern] ?? 0) + count;
  const { examples } = plan;
  const isByShape = plan.criterion === 'shape';
  const demand = isByShape ? 1000 * (plan.largest_loss_m ?? 0) : (plan.detail_demand ?? 0);
  return {
    examples: examples.map(({ name }) => name),
    patterns: counts.map((nVertices, pattern) => {
      const centres = examples.flatMap(({ centres_per_m: own }) => own.slice(pattern, pattern + 1));
      const meansPerM = centres.map(([mean]) => mean);
      const deviationsPerM = centres.map(([, deviation]) => deviation);
      return { meansPerM, deviationsPerM, nVertices };
    }),
    nVertices: plan.vertices,
    hasLimits: plan.curvature_limits_per_m.length > 0,
    nSplits: plan.splits.length,
    nForBalance: plan.splits.filter((split) => split[2] === 'balance').length,
    isByShape,
    rule:
      plan.vertex_budget === undefined
        ? { kind: 'demand', value: demand }
        : { kind: 'budget', value: plan.vertex_budget },
  };
}

function rounded(value: number): string {
  return String(Number(value.toFixed(2)));
}

function whySplit([, demand, reason]: PlanSplit, { rule, isByShape }: PlanStory): string {
  if (reason === 'balance')
    return 'only because a neighbour became two levels finer: faces side by side differ by one level at most';
  if (isByShape)
    return `because it lost ${rounded(1000 * demand)} mm of the example's shapes, and splitting it saved most for the vertices it adds`;
  const sum = rounded(demand);
  if (rule.kind === 'budget')
    return `because its corners ask for ${sum} together, among the most that still fit into ${rule.value} vertices`;
  return `because its corners ask for ${sum} together, more than ${rounded(rule.value)}`;
}

function whyNotSplit({ level, corners }: Face, plan: PlanFile, story: PlanStory): string {
  const { rule, isByShape } = story;
  if (level >= plan.level_cap) return 'It is as fine as the fine mesh.';
  if (isByShape)
    return rule.kind === 'budget'
      ? 'It was not split further: vertices save more elsewhere, or there is no room left.'
      : `It was not split further: vertices save more elsewhere, and no more than ${rounded(rule.value)} mm are lost on the whole.`;
  if (rule.kind === 'budget')
    return 'It was not split further: others ask for more, or there is no room left.';
  if (level > 0)
    return `It was not split further: what its corners still ask for is not more than ${rounded(rule.value)}.`;
  const patterns = basePatterns(plan);
  const own = corners.map((vertex) => patterns[vertex] ?? 0);
  const sum = own.reduce((total, pattern) => total + pattern, 0);
  return `It was not split: the patterns at its corners, ${own.join(' + ')} = ${sum}, are not more than ${rounded(rule.value)}.`;
}

/** Why a face of the plan's mesh is as fine as it is. */
export function faceStory(face: Face, plan: PlanFile): string {
  const story = planStory(plan);
  const split = plan.splits.find(([id]) => id === face.parent);
  const origin = split
    ? `A face of level ${face.level} of ${plan.level_cap}. Its parent was split ${whySplit(split, story)}.`
    : `A face of the base mesh, level 0 of ${plan.level_cap}.`;
  return `${origin} ${whyNotSplit(face, plan, story)}`;
}
