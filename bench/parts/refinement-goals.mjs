// Rows of runs on meshes of one garment, their table, and what was promised of them.
import { goal, markdown, median, short } from './bench-rows.mjs';

/** Of the fine mesh's. */
const kMostVertices = 1 / 3;
/** Of a plan's faults over a uniform mesh's, by garment. */
const kMostFaults = { skirt: 0.9, trousers: 0.9, slim_trousers: 0.75 };
/** Of the distance of two fine runs without friction. */
const kMostChance = 0.5;
/** By which a uniform mesh may have other than as many vertices. */
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
  const [first] = runs;
  const times = runs.map((run) => run.ms_per_frame);
  return {
    label: `multi, ${first.target}`,
    garment,
    scene: scene.name,
    method: scene.method,
    n_vertices: first.n_vertices,
    ms_per_frame: median(times),
    spread_ms: Math.max(...times) - Math.min(...times),
    contact_ms: median(runs.map((run) => run.contact_ms)),
    n_runs: runs.length,
    n_timed_frames: first.n_timed_frames,
    errors,
    errors_target: 'native',
    reference,
    status: first.status,
    message: first.message,
    target: first.target,
    commit,
  };
}

const milli = (value) => short(1e3 * (value ?? Number.NaN));

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
export function pooledFolds(runs) {
  const [first] = runs;
  return first.map((ring, r) =>
    ring.map((_, n) =>
      Math.sqrt(runs.reduce((sum, rings) => sum + rings[r][n] ** 2, 0) / runs.length),
    ),
  );
}

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

/** Two halves of the fine runs against each other: what chance alone makes of that [m]. */
export function foldFloor(fineRuns) {
  const half = Math.floor(fineRuns.length / 2);
  return foldDistance(pooledFolds(fineRuns.slice(0, half)), pooledFolds(fineRuns.slice(half)));
}

const rootMeanSquare = (values) =>
  Math.sqrt(values.reduce((sum, value) => sum + value ** 2, 0) / values.length);

/** Root mean square distances after restarts [m], by mesh. */
export const restartFaults = (restarts) =>
  restarts.map(({ errors_m }) => rootMeanSquare(errors_m.map((error) => error ?? Number.NaN)));

export function runTable(rows) {
  const [fine] = rows;
  const head = [
    'mesh',
    'vertices',
    '% of fine',
    'ms/frame',
    'dynamics',
    'contact',
    'refinement',
    'of fine',
    'sampled mm',
    'sampled °',
    'folds mm',
    'bend 1/m',
    'over time',
    'surface mm',
    'position mm',
    'rms stretch %',
    'longest edge %',
    'frames with a vertex inside',
    'status',
  ];
  const lines = rows.map((row) => [
    row.label,
    row.n_vertices,
    short((100 * row.n_vertices) / fine.n_vertices),
    short(row.ms_per_frame),
    short(row.dynamics_ms),
    short(row.contact_ms),
    short(row.refinement_ms),
    short(row.ms_per_frame / fine.ms_per_frame),
    milli(row.errors.sampling_m),
    short(kDegrees * (row.errors.sampling_rad ?? Number.NaN)),
    milli(folds(row, fine)),
    short(row.errors.bend_per_m ?? Number.NaN),
    short(row.errors.bend_over_time_per_m ?? Number.NaN),
    milli(row.errors.surface_m),
    milli(row.errors.position_m),
    short(100 * row.rms_stretch),
    short(100 * row.longest_edge),
    `${row.inside.n_frames} (unpinned ${row.unpinned_inside.n_frames})`,
    row.status,
  ]);
  return markdown(head, lines);
}

/** Both builds of one run; errors in WebAssembly are taken to be the native run's. */
export function buildTable({ wasm, native }) {
  const head = [
    'target',
    'vertices',
    'ms/frame',
    'spread',
    'contact',
    'of native',
    'bend 1/m',
    'surface mm',
    'position mm',
    'status',
  ];
  const lines = [wasm, native].map((row) => [
    row.target,
    row.n_vertices,
    short(row.ms_per_frame),
    short(row.spread_ms),
    short(row.contact_ms),
    short(row.ms_per_frame / native.ms_per_frame),
    short(row.errors.bend_per_m ?? Number.NaN),
    milli(row.errors.surface_m),
    milli(row.errors.position_m),
    row.status,
  ]);
  return markdown(head, lines);
}

/** A frame takes no longer than it shows; `scale` as of runParts. */
export function wasmGoals(garment, wasm, scale) {
  const name = `${garment}_multi_ms_per_frame_wasm`;
  return [goal(name, wasm.ms_per_frame, 'at-most', kFrameMs * scale, [wasm])];
}

/** Frames until the example run and the plan have been saved again. */
export function framesToPay(plans, fine, multi) {
  const saved = fine.ms_per_frame - multi.ms_per_frame;
  return saved > 0 ? (1e3 * (plans.example_s + plans.planning_s)) / saved : Number.NaN;
}

/** Of the comparison on the test motion. */
export function comparisonGoals(garment, { fine, multi, same, faults }) {
  const share = multi.n_vertices / fine.n_vertices;
  const rows = [fine, multi, same];
  const ratio = (key) => multi.errors[key] / same.errors[key];
  const most = kMostFaults[garment];
  const at = (name, value, bound, of = rows) =>
    goal(`${garment}_${name}`, value, 'at-most', bound, of);
  const apart = Math.abs(multi.n_vertices / same.n_vertices - 1);
  return [
    at('vertices_share', share, kMostVertices),
    at('vertices_from_uniform', apart, kMostVerticesApart, [multi, same]),
    at(
      'time_share',
      multi.ms_per_frame / fine.ms_per_frame,
      Math.min(kMostTime, kTimePerVertex * share),
    ),
    at('sampling_to_uniform', ratio('sampling_m'), most, [multi, same]),
    at('sampled_normals_to_uniform', ratio('sampling_rad'), most, [multi, same]),
    at('restarts_to_uniform', faults.restarts.multi / faults.restarts.same, most),
    at('folds_to_uniform', faults.folds.multi.pooled / faults.folds.same.pooled, most),
    at('refinement_ms_per_frame', multi.refinement_ms, 0, [multi]),
  ];
}

/**
 * What has no bound: curvature of all times together, in which folds that two runs have at other
 * times count as the same; and both errors of a second run on the fine mesh in air that is heavier
 * by a trifle, below which no mesh can be told from another.
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

/** What chance and the mesh have to do with it: pools, their spread, and floors. */
export function faultTable({ folds: fold, floor, restarts }) {
  const head = ['mesh', 'folds mm, pooled', 'runs from', 'to', 'after restarts mm'];
  const line = (label, { pooled, least, most }, restart) => [
    label,
    milli(pooled),
    milli(least),
    milli(most),
    milli(restart),
  ];
  return markdown(head, [
    line('multi', fold.multi, restarts.multi),
    line('uniform of as many', fold.same, restarts.same),
    line('fine, the floor', { pooled: floor, least: Number.NaN, most: Number.NaN }, restarts.twin),
  ]);
}

/** How near further fine runs stay with friction inside of bent cloth, in the place of none. */
export function frictionGoals({ without, withFriction }) {
  const apart = (rows) => rows.map((row) => row.errors.position_m);
  const mean = (numbers) => numbers.reduce((sum, number) => sum + number, 0) / numbers.length;
  const ratio = mean(apart(withFriction)) / mean(apart(without));
  const listed = (rows) => apart(rows).map(milli).join(', ');
  return {
    goals: [
      goal('skirt_twins_with_friction_to_without', ratio, 'at-most', kMostChance, [
        ...withFriction,
        ...without,
      ]),
    ],
    text: `mm apart without friction ${listed(without)}; with it ${listed(withFriction)}`,
  };
}

const firings = ({ fit }) => (fit.first_fired === null ? 0 : 1);

/** Does the monitor tell the example's kind of motion from others? */
export function monitorGoals(garment, { example, test, squat, turn }) {
  return [
    goal(
      `${garment}_monitor_outside_percent_on_the_example`,
      100 * example.fit.share_outside,
      'at-most',
      1,
      [example],
    ),
    goal(`${garment}_monitor_fires_on_the_test_walk`, firings(test), 'at-most', 0, [test]),
    goal(`${garment}_monitor_fires_on_the_turn`, firings(turn), 'at-most', 0, [turn]),
    goal(`${garment}_monitor_fires_on_the_squat`, firings(squat), 'at-least', 1, [squat]),
  ];
}

/** No vertex inside of the mannequin, in any frame of these rows. */
export function insideGoals(garment, rows) {
  return rows.map((row) =>
    goal(`${garment}_frames_with_a_vertex_inside_${row.label}`, row.inside.n_frames, 'at-most', 0, [
      row,
    ]),
  );
}

/** Legs lengthen no edge of trousers by more than this share, in any motion; a skirt has none. */
const kLongestEdge = 0.15;

export function stretchGoals(garment, rows) {
  if (garment === 'skirt') return [];
  const longest = Math.max(...rows.map((row) => row.longest_edge));
  return [goal(`${garment}_longest_edge_stretch`, longest, 'at-most', kLongestEdge, rows)];
}

export function monitorTable(rows) {
  const head = ['motion', 'mesh', 'faces outside %', 'worst frame %', 'fires after', 'status'];
  const lines = rows.map(({ label, n_vertices, fit, status }) => [
    label,
    n_vertices,
    short(100 * fit.share_outside),
    short(100 * fit.worst_share),
    fit.first_fired === null ? 'never' : `${fit.first_fired + 1} frames`,
    status,
  ]);
  return markdown(head, lines);
}
