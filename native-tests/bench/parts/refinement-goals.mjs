// Rows of runs on meshes of one garment, their table, and what was promised of them.
import { goal, markdown, median, short } from './bench-rows.mjs';

/** Bounds of the share of vertices, by garment. */
export const kMostVertices = { skirt: 1 / 3, trousers: 1 / 4 };
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
export function comparisonGoals(garment, { fine, multi, same }) {
  const share = multi.n_vertices / fine.n_vertices;
  const rows = [fine, multi, same];
  const ratio = (key) => multi.errors[key] / same.errors[key];
  const at = (name, value, bound, of = rows) =>
    goal(`${garment}_${name}`, value, 'at-most', bound, of);
  return [
    at('vertices_share', share, kMostVertices[garment]),
    at(
      'time_share',
      multi.ms_per_frame / fine.ms_per_frame,
      Math.min(kMostTime, kTimePerVertex * share),
    ),
    at('bend_error_to_uniform', ratio('bend_per_m'), 0.6),
    at('surface_error_to_uniform', ratio('surface_m'), 0.8),
    at('sampling_to_uniform', ratio('sampling_m'), 0.9, [multi, same]),
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

const firings = ({ fit }) => (fit.first_fired === null ? 0 : 1);

/** Does the monitor tell the example's kind of motion from others? */
export function monitorGoals(garment, { example, test, squat }) {
  return [
    goal(
      `${garment}_monitor_outside_percent_on_the_example`,
      100 * example.fit.share_outside,
      'at-most',
      1,
      [example],
    ),
    goal(`${garment}_monitor_fires_on_the_test_walk`, firings(test), 'at-most', 0, [test]),
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
