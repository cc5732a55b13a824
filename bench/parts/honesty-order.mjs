// Compares the order of a sweep's settings with their order against the truth: a run on twice the
// mesh with a quarter of the step and another solver.
import { changed, shippedScene } from './assets.mjs';
import { tell } from './bench-options.mjs';
import { atLeast, hasFinished, rankCorrelation, table } from './bench-rows.mjs';
import { askRows, cacheFolder, nativeRun, reference } from './command.mjs';

const kFewestRanked = 5; // an order of fewer settings says little

// How long each is compared [s], as on the page: later on their motions are chance.
const kScenes = { curtain: 1, swinging_sheet: 0.4, tablecloth: 0.4 };
const kTruthStep = 1 / 960; // [s], a quarter of the smallest substep of implicit

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

/** "xpbd, 10 substeps x 2" */
export function methodWords({ stepper, iterations }, substeps) {
  return `${stepper}, ${substeps} substeps${iterations > 1 ? ` x ${iterations}` : ''}`;
}

export async function order() {
  const rows = [];
  const correlations = {};
  const told = [];
  for (const [name, duration] of Object.entries(kScenes)) {
    const found = judged(shippedScene(name), duration);
    const ranked = found.filter((row) => row.position_error_m > 0 && row.truth_m > 0);
    const [errors, truths] = ['position_error_m', 'truth_m'].map((of) =>
      ranked.map((row) => row[of]),
    );
    const tells = ranked.length >= kFewestRanked;
    correlations[name] = tells ? rankCorrelation(errors, truths) : Number.NaN;
    told.push(`${name} ${ranked.length} of ${found.length}`);
    rows.push(...found);
  }
  const columns = {
    scene: 'scene',
    method: ({ method }) => methodWords(method, method.substeps ?? 1),
    'ms/frame': 'ms_per_frame',
    'sweep: mm': (row) => 1e3 * row.position_error_m,
    'truth: mm': (row) => 1e3 * row.truth_m,
    status: 'status',
  };
  const truths = [...new Set(rows.map((row) => row.truth.description))].join('; ');
  const text = `the order of a sweep against ${truths}; ranked: ${told.join(', ')}\n\n${table(rows, columns)}`;
  const goals = Object.entries(correlations).map(([name, correlation]) =>
    atLeast(`order_${name}`, correlation, 0.95, rows),
  );
  return { rows, goals, text };
}
