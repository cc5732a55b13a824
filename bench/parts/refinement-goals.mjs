// Rows of runs on meshes of one garment, their table, and what was promised of them.
import { atLeast, atMost, markdown, mean, medianRow, short, spread, table } from './bench-rows.mjs';

/** Share of the fine mesh's. */
const kMostVertices = 1 / 3;
/** A plan's faults over a uniform mesh's, by garment. */
const kMostFaults = { skirt: 0.9, trousers: 0.9, slim_trousers: 0.75 };
/** Share of the distance of two fine runs without friction. */
const kMostChance = 0.5;
/** Share by which a uniform mesh may have more or fewer vertices. */
const kMostVerticesApart = 0.03;
const kMostTime = 0.3;
const kTimePerVertex = 1.15;
const kFrameMs = 1e3 / 30; // [ms] that a frame shows

/** A run's row, as the command tells it. */
export const runRow = (label, run, { garment, commit }) => ({ label, garment, ...run, commit });

/**
 * A row of one run, repeated, in one build. Errors are the native run's in both builds: they are
 * told by runs in one process with the fine mesh.
 */
export function buildRow(runs, { garment, scene, errors, reference, commit }) {
  const { n_vertices, ms_per_frame, contact_ms, n_timed_frames, status, message, target } =
    medianRow(runs, ['ms_per_frame', 'contact_ms']);
  return {
    label: `multi, ${target}`,
    garment,
    scene: scene.name,
    method: scene.method,
    n_vertices,
    ms_per_frame,
    spread_ms: spread(runs.map((run) => run.ms_per_frame)),
    contact_ms,
    n_runs: runs.length,
    n_timed_frames,
    errors,
    errors_target: 'native',
    reference,
    status,
    message,
    target,
    commit,
  };
}

const milli = (value) => 1e3 * (value ?? Number.NaN);

const rootMeanSquare = (values) => Math.sqrt(mean(values.map((value) => value ** 2)));

/**
 * How differently two runs are folded [m], as docs/methods/error_measures.md has it; lists of
 * amplitudes for each ring.
 */
export function foldDistance(rings, others) {
  const squares = rings.flatMap((ring, r) => ring.map((value, n) => (value - others[r][n]) ** 2));
  return Math.sqrt(squares.reduce((sum, square) => sum + square, 0) / rings.length);
}

const kDegrees = 180 / Math.PI;

const folds = (row, fine) =>
  row.folds_m.length > 0 && row.folds_m.length === fine.folds_m.length
    ? foldDistance(row.folds_m, fine.folds_m)
    : Number.NaN;

/** Amplitudes of several runs as one, root mean squares. */
const pooledFolds = (runs) =>
  runs[0].map((ring, r) => ring.map((_, n) => rootMeanSquare(runs.map((rings) => rings[r][n]))));

/**
 * How differently folded the pools of two meshes' runs are [m], and the least and the most that a
 * run of the first alone is from the other pool.
 */
export function foldFault(runs, fineRuns) {
  const fine = pooledFolds(fineRuns);
  const alone = runs.map((rings) => foldDistance(rings, fine));
  return {
    pooled: foldDistance(pooledFolds(runs), fine),
    least: Math.min(...alone),
    most: Math.max(...alone),
  };
}

/** Two halves of the fine runs against each other: the distance that chance alone makes [m]. */
export function foldFloor(fineRuns) {
  const half = Math.floor(fineRuns.length / 2);
  return foldDistance(pooledFolds(fineRuns.slice(0, half)), pooledFolds(fineRuns.slice(half)));
}

/** Root mean square distances after restarts [m], by mesh. */
export const restartFaults = (restarts) =>
  restarts.map(({ errors_m }) => rootMeanSquare(errors_m.map((error) => error ?? Number.NaN)));

export function runTable(rows) {
  const [fine] = rows;
  return table(rows, {
    mesh: 'label',
    vertices: 'n_vertices',
    '% of fine': (row) => (100 * row.n_vertices) / fine.n_vertices,
    'ms/frame': 'ms_per_frame',
    dynamics: 'dynamics_ms',
    contact: 'contact_ms',
    refinement: 'refinement_ms',
    'of fine': (row) => row.ms_per_frame / fine.ms_per_frame,
    'sampled mm': (row) => milli(row.errors.sampling_m),
    'sampled °': (row) => kDegrees * (row.errors.sampling_rad ?? Number.NaN),
    'folds mm': (row) => milli(folds(row, fine)),
    'bend 1/m': (row) => row.errors.bend_per_m,
    'over time': (row) => row.errors.bend_over_time_per_m,
    'surface mm': (row) => milli(row.errors.surface_m),
    'position mm': (row) => milli(row.errors.position_m),
    'rms stretch %': (row) => 100 * row.rms_stretch,
    'longest edge %': (row) => 100 * row.longest_edge,
    'frames with a vertex inside': (row) =>
      `${row.inside.n_frames} (unpinned ${row.unpinned_inside.n_frames})`,
    status: 'status',
  });
}

/** Both builds of one run; errors in WebAssembly are taken to be the native run's. */
export const buildTable = ({ wasm, native }) =>
  table([wasm, native], {
    target: 'target',
    vertices: 'n_vertices',
    'ms/frame': 'ms_per_frame',
    spread: 'spread_ms',
    contact: 'contact_ms',
    'of native': (row) => row.ms_per_frame / native.ms_per_frame,
    'bend 1/m': (row) => row.errors.bend_per_m,
    'surface mm': (row) => milli(row.errors.surface_m),
    'position mm': (row) => milli(row.errors.position_m),
    status: 'status',
  });

/** A frame takes no longer than it shows; `scale` as of runParts. */
export const wasmGoals = (garment, wasm, scale) => [
  atMost(`${garment}_multi_ms_per_frame_wasm`, wasm.ms_per_frame, kFrameMs * scale, [wasm]),
];

/** Frames until the example run and the plan have been saved again. */
export function framesToPay(plans, fine, multi) {
  const saved = fine.ms_per_frame - multi.ms_per_frame;
  return saved > 0 ? (1e3 * (plans.example_s + plans.planning_s)) / saved : Number.NaN;
}

/** Goals of the comparison on the test motion. */
export function comparisonGoals(garment, { fine, multi, same, faults }) {
  const share = multi.n_vertices / fine.n_vertices;
  const two = [multi, same];
  const rows = [fine, ...two];
  const ratio = (key) => multi.errors[key] / same.errors[key];
  const most = kMostFaults[garment];
  const at = (name, value, bound, of = rows) => atMost(`${garment}_${name}`, value, bound, of);
  const apart = Math.abs(multi.n_vertices / same.n_vertices - 1);
  const time = multi.ms_per_frame / fine.ms_per_frame;
  return [
    at('vertices_share', share, kMostVertices),
    at('vertices_from_uniform', apart, kMostVerticesApart, two),
    at('time_share', time, Math.min(kMostTime, kTimePerVertex * share)),
    at('sampling_to_uniform', ratio('sampling_m'), most, two),
    at('sampled_normals_to_uniform', ratio('sampling_rad'), most, two),
    at('restarts_to_uniform', faults.restarts.multi / faults.restarts.same, most),
    at('folds_to_uniform', faults.folds.multi.pooled / faults.folds.same.pooled, most),
    at('refinement_ms_per_frame', multi.refinement_ms, 0, [multi]),
  ];
}

/**
 * Ratios without a bound: curvature of all times together, in which folds that two runs have at
 * other times count as the same; and both errors of a second run on the fine mesh in air that is
 * heavier by a trifle, below which no mesh can be told from another.
 */
export function shownLines(garment, { fine, multi, same, twin }) {
  const of = (row, key) => row.errors[key] ?? Number.NaN;
  const shown = (name, key) =>
    `shown ${garment}_${name}_to_uniform ${short(of(multi, key) / of(same, key))}, a second ${fine.label} run's ${short(of(twin, key) / of(same, key))}`;
  return [
    shown('bend_over_time_error', 'bend_over_time_per_m'),
    shown('bend_error', 'bend_per_m'),
    shown('surface_error', 'surface_m'),
  ].join('\n');
}

/** Shares of chance and of the mesh: pools, their spread, and floors. */
export function faultTable({ folds: fold, floor, restarts }) {
  const head = ['mesh', 'folds mm, pooled', 'runs from', 'to', 'after restarts mm'];
  const line = (label, { pooled, least, most }, restart) => [
    label,
    ...[pooled, least, most, restart].map(milli),
  ];
  return markdown(head, [
    line('multi', fold.multi, restarts.multi),
    line('uniform of as many', fold.same, restarts.same),
    line('fine, the floor', { pooled: floor }, restarts.twin),
  ]);
}

/** How near further fine runs stay with friction inside of bent cloth, in the place of none. */
export function frictionGoals({ without, withFriction }) {
  const apart = (rows) => rows.map((row) => row.errors.position_m);
  const ratio = mean(apart(withFriction)) / mean(apart(without));
  const listed = (rows) => apart(rows).map(milli).map(short).join(', ');
  const rows = [...withFriction, ...without];
  return {
    goals: [atMost('skirt_twins_with_friction_to_without', ratio, kMostChance, rows)],
    text: `mm apart without friction ${listed(without)}; with it ${listed(withFriction)}`,
  };
}

const firings = ({ fit }) => (fit.first_fired === null ? 0 : 1);

/** Does the monitor tell the example's kind of motion from others? */
export function monitorGoals(garment, { example, test, squat, turn }) {
  const name = `${garment}_monitor`;
  const outside = 100 * example.fit.share_outside;
  return [
    atMost(`${name}_outside_percent_on_the_example`, outside, 1, [example]),
    atMost(`${name}_fires_on_the_test_walk`, firings(test), 0, [test]),
    atMost(`${name}_fires_on_the_turn`, firings(turn), 0, [turn]),
    atLeast(`${name}_fires_on_the_squat`, firings(squat), 1, [squat]),
  ];
}

/** No vertex inside of the mannequin, in any frame of these rows. */
export const insideGoals = (garment, rows) =>
  rows.map((row) => {
    const name = `${garment}_frames_with_a_vertex_inside_${row.label}`;
    return atMost(name, row.inside.n_frames, 0, [row]);
  });

/** Legs lengthen no edge of trousers by more than this share, in any motion; a skirt has none. */
const kLongestEdge = 0.15;

export function stretchGoals(garment, rows) {
  if (garment === 'skirt') return [];
  const longest = Math.max(...rows.map((row) => row.longest_edge));
  return [atMost(`${garment}_longest_edge_stretch`, longest, kLongestEdge, rows)];
}

export const monitorTable = (rows) =>
  table(rows, {
    motion: 'label',
    mesh: 'n_vertices',
    'faces outside %': ({ fit }) => 100 * fit.share_outside,
    'worst frame %': ({ fit }) => 100 * fit.worst_share,
    'fires after': ({ fit }) =>
      fit.first_fired === null ? 'never' : `${fit.first_fired + 1} frames`,
    status: 'status',
  });
