// Whether a sweep puts settings into the order that they have against the truth: a run on twice the
// mesh with a quarter of the step and another solver, compared here.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

import { tell } from './bench-parts.mjs';
import { goal, hasFinished, markdown, short } from './bench-rows.mjs';
import { askRows, cacheFolder, nativeRun, reference, root } from './command.mjs';
import { changed } from './honesty-warnings.mjs';

const kFewestRanked = 5; // of fewer settings an order says little

// How long each is compared [s], as on the page: later on their motions are chance.
const kScenes = { curtain: 1, swinging_sheet: 0.4, tablecloth: 0.4 };
const kTruthStep = 1 / 960; // [s], a quarter of the smallest substep of implicit

/** Places in ascending order; equal values share the mean of theirs. */
function ranks(values) {
  return values.map((value) => {
    const smaller = values.filter((other) => other < value).length;
    const equal = values.filter((other) => other === value).length;
    return smaller + (equal + 1) / 2;
  });
}

/** Spearman's rank correlation, in [-1, 1]; NaN where there is nothing to rank. */
export function rankCorrelation(a, b) {
  const [x, y] = [ranks(a), ranks(b)];
  const mean = (a.length + 1) / 2;
  const product = (p, q) => p.reduce((sum, value, k) => sum + (value - mean) * (q[k] - mean), 0);
  return product(x, y) / Math.sqrt(product(x, x) * product(y, y));
}

/**
 * RMS distance over samples and cloth [m], at the vertices that both have: those of a coarser mesh
 * come first in a finer one.
 */
export function distance(samples, truth, masses) {
  const total = masses.reduce((sum, mass) => sum + mass) * samples.length;
  let squares = 0;
  for (const [s, { positions_m: ours }] of samples.entries())
    for (const [v, mass] of masses.entries())
      for (let k = 3 * v; k < 3 * v + 3; ++k)
        squares += mass * (ours[k] - truth[s].positions_m[k]) ** 2;
  return Math.sqrt(squares / total);
}

/** The ends of frames nearest to the times at which a sweep compares [s]. */
const timesOf = (duration) =>
  Array.from({ length: 10 }, (_, k) => Math.round((k + 1) * 6 * duration) / 60);

function truthOf(scene, times) {
  const method = { stepper: 'newton', rule: 'midpoint', step_s: kTruthStep, solver: 'supernodal' };
  const finer = { level: scene.refinement.level + 1 };
  return reference({ ...scene, refinement: finer, method }, 'run', times);
}

/** The sweep's rows with their distances from the truth. */
function judged(scene, duration) {
  const times = timesOf(duration);
  const sweep = ['--duration', duration, '--repeat', 1, '--cache', cacheFolder, '--json'];
  tell(`${scene.name}: the sweep`);
  const rows = askRows('sweep', scene, ...sweep);
  tell(`${scene.name}: the truth`);
  const truth = truthOf(scene, times);
  return rows.map((row) => {
    tell(`${scene.name}: ${row.method.stepper} against the truth`);
    const run = nativeRun(changed(scene, row.setting), 60 * duration, times);
    const ended = hasFinished(run) && run.samples.length === times.length;
    const truth_m = ended ? distance(run.samples, truth.samples, run.masses_kg) : Number.NaN;
    return { ...row, truth_m, truth: truth.reference };
  });
}

function describe({ method }) {
  const iterations = method.iterations > 1 ? ` x ${method.iterations}` : '';
  return `${method.stepper}, ${method.substeps ?? 1} substeps${iterations}`;
}

export async function order() {
  const rows = [];
  const correlations = [];
  const told = [];
  for (const [name, duration] of Object.entries(kScenes)) {
    const scene = JSON.parse(readFileSync(join(root, 'assets', 'scenes', `${name}.json`), 'utf8'));
    const found = judged(scene, duration);
    const ranked = found.filter((row) => row.position_error_m > 0 && row.truth_m > 0);
    const errors = (key) => ranked.map((row) => row[key]);
    const tells = ranked.length >= kFewestRanked;
    correlations.push(
      tells ? rankCorrelation(errors('position_error_m'), errors('truth_m')) : Number.NaN,
    );
    told.push(`${name} ${ranked.length} of ${found.length}`);
    rows.push(...found);
  }
  const lines = rows.map((row) => [
    row.scene,
    describe(row),
    short(row.ms_per_frame),
    short(1e3 * row.position_error_m),
    short(1e3 * row.truth_m),
    row.status,
  ]);
  const head = ['scene', 'method', 'ms/frame', 'sweep: mm', 'truth: mm', 'status'];
  const truths = [...new Set(rows.map((row) => row.truth.description))];
  const text = `the order of a sweep against ${truths.join('; ')}; ranked: ${told.join(', ')}\n\n${markdown(head, lines)}`;
  const goals = Object.keys(kScenes).map((name, k) =>
    goal(`truth.order_${name}`, correlations[k], 'at-least', 0.95, rows),
  );
  return { rows, goals, text };
}
