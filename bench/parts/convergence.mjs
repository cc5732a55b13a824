// One step solved by each position-based method from the same predicted places: error against time.
import { tell } from './bench-parts.mjs';
import { goal, markdown, short } from './bench-rows.mjs';
import { ask, nativeRun } from './command.mjs';
import { squareSheet } from './square-sheet.mjs';

const kStep = 1 / 60; // [s]
const kErrors = [1e-1, 1e-2, 1e-3];
const kMostRounds = 513;
const kSizes = [33, 65, 129];

const kCorners = [{ part: 'upper_left' }, { part: 'upper_right' }];
const upright = (n) => squareSheet(n, [0, 0, 0], [0, -1, 0], [1, 0, 0]);
const lying = (n) => squareSheet(n, [0, 0, 0], [0, 0, 1], [1, 0, 0]);
const comes = (x, z) => ({ kind: 'ease', offset_m: [x, 0, z], begin_s: 0, end_s: 1 });
/** Out of the sheet's plane [m]: in it no fold forms, and cloth that is gathered is crushed. */
const kTwist = 0.05;

/** What the step is of, and when it begins [s]. */
const kSteps = {
  hang: { cloth: upright, pins: kCorners, at: 0 },
  swing: { cloth: lying, pins: kCorners, at: 0.25 },
  gathered: {
    cloth: upright,
    pins: [
      { part: 'upper_left', motion: comes(0.25, kTwist) },
      { part: 'upper_right', motion: comes(-0.25, -kTwist) },
    ],
    at: 0.5,
  },
};

function sceneOf(name, n, bending) {
  const { cloth, pins } = kSteps[name];
  return {
    name: `${name} ${n}x${n}`,
    cloth: cloth(n),
    fabric: { name: 'fine cotton' },
    model: { bending },
    pins,
    duration_s: 1,
    method: { stepper: 'xpbd', constraints: 'rigid', step_s: kStep, substeps: 30 },
  };
}

const pbd = (smoother, omega) => ({
  label: omega ? `${smoother} ${omega}` : smoother,
  method: { stepper: 'pbd', smoother, ...(omega ? { omega } : {}) },
});
const kGaussSeidel = pbd('gauss_seidel');
const kPlain = [kGaussSeidel, ...[1.3, 1.6, 1.8, 1.9].map((omega) => pbd('sor', omega))];
const kLanes = { label: 'xpbd, lines', method: { stepper: 'xpbd' } };
const kHierarchical = { label: 'hpbd', method: { stepper: 'hpbd' } };
/** Levels that iterate: by errors, without attachments. */
const multigrid = (label, more = {}) => ({
  label,
  method: {
    stepper: 'multigrid',
    level_lengths: 'error',
    attachments: 'none',
    smoother_before: 'none',
    ...more,
  },
});
const kMultigrid = multigrid('multigrid');
/** With so many levels that some 50 vertices are left. */
const multigridFor = (n) => {
  const levels = Math.max(1, Math.round(Math.log2((n * n) / 50) / 2));
  return multigrid('multigrid', { levels });
};

const smoothing = (before, after) =>
  multigrid(`V(${before}, ${after})`, { smoother_before: before, smoother: after });
const kSmoothings = [
  smoothing('gauss_seidel', 'gauss_seidel'),
  smoothing('sor', 'gauss_seidel'),
  smoothing('sor', 'sor'),
  smoothing('jacobi', 'gauss_seidel'),
];
const kRatios = [0.5, 0.33, 0.25, 0.125].map((ratio) => multigrid(`ratio ${ratio}`, { ratio }));

/** Error against time of each method on one step; a row for each, of its points. */
function solved(name, n, bending, contestants, repeat, words = []) {
  tell(`${name} ${n}x${n}, bending ${bending}`);
  const { at } = kSteps[name];
  const study = ask(
    'convergence',
    sceneOf(name, n, bending),
    ...['--at', at, '--repeat', repeat, '--rounds', kMostRounds, '--json'],
    ...['--methods', contestants.map(({ method }) => ({ step_s: kStep, ...method }))],
    ...words,
  );
  return contestants.map(({ label }, i) => {
    const { points, method, distance_begin_m, distance_unknown_m } = study.series[i];
    return {
      scene: study.scene,
      bending,
      label,
      n_vertices: study.n_vertices,
      method,
      distance_begin_m,
      distance_unknown_m,
      points,
      status: 'ok',
      core: study.core,
    };
  });
}

const pointAt = ({ points }, error) =>
  points.find(({ relative_error }) => relative_error !== null && relative_error <= error);
const msTo = (row, error) => pointAt(row, error)?.ms ?? Number.POSITIVE_INFINITY;
const longest = ({ points }) => Math.max(...points.map(({ ms }) => ms));
const best = (rows, error) => Math.min(...rows.map((row) => msTo(row, error)));

function linesOf(rows) {
  return rows.map((row) => {
    const last = row.points.at(-1);
    return [
      row.scene,
      row.bending,
      row.label,
      ...kErrors.map((error) => {
        const point = pointAt(row, error);
        return point ? `${short(point.ms)} (${short(point.sweeps)})` : '-';
      }),
      short(last.relative_error),
    ];
  });
}

/** The drape that so many rounds a step make of a fall: how far it is stretched, and its cost. */
function drapes() {
  const lines = [];
  for (const iterations of [3, 5, 9, 27])
    for (const stepper of ['pbd', 'hpbd', 'multigrid']) {
      tell(`drape, ${iterations} rounds: ${stepper}`);
      const method = { stepper, substeps: 1, iterations, step_s: kStep };
      const run = nativeRun({ ...sceneOf('swing', 33, 'quadratic'), duration_s: 3, method }, 180);
      const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;
      const ms = [...run.ms].sort((a, b) => a - b)[run.ms.length >> 1];
      lines.push([
        iterations,
        stepper,
        short(ms),
        short(100 * mean(run.rms_stretch.slice(-30))),
        run.status,
      ]);
    }
  return markdown(['rounds', 'method', 'ms/frame', 'rms stretch %', 'status'], lines);
}

const kWhole = [
  ...[1e-1, 1e-2, 1e-3].map((tolerance) => ({
    label: `implicit ${tolerance}`,
    method: { stepper: 'implicit', tolerance },
  })),
  { label: 'projective', method: { stepper: 'projective' } },
];

/** Milliseconds to shares of the distance to each method's own solution, with compliant springs. */
function firstToDistance(repeat) {
  const contestants = [...kPlain, kHierarchical, kMultigrid, kLanes, ...kWhole];
  const words = ['--constraints', 'compliant'];
  const rows = solved('hang', 51, 'quadratic', contestants, repeat, words);
  const shares = [1e-1, 1e-2, 1e-3, 1e-4];
  const lines = rows.map(({ label, points }) => [
    label,
    ...shares.map((share) => {
      const at = points.find(({ relative_distance }) => relative_distance <= share);
      return at ? short(at.ms) : '-';
    }),
    short(points.at(-1).relative_distance),
  ]);
  const head = ['method', ...shares.map((share) => `ms to ${share}`), 'last distance'];
  return { rows, text: markdown(head, lines) };
}

/** How much sooner levels have the error that is the least of 257 sweeps of one level. */
function advantages(repeat) {
  const rows = [];
  const found = Object.keys(kSteps).map((name) =>
    kSizes.map((n) => {
      const solvedRows = solved(name, n, 'quadratic', [...kPlain, multigridFor(n)], repeat);
      rows.push(...solvedRows);
      const plain = solvedRows
        .slice(0, -1)
        .map(({ points }) => points.findLast(({ rounds }) => rounds <= 257));
      const least = plain.reduce((a, b) => (a.relative_error <= b.relative_error ? a : b));
      return least.ms / msTo(solvedRows.at(-1), least.relative_error);
    }),
  );
  const lines = Object.keys(kSteps).map((name, i) => [name, ...found[i].map(short)]);
  const growth = (name) => {
    const of = found[Object.keys(kSteps).indexOf(name)];
    return Math.min(...of.slice(1).map((advantage, i) => advantage / of[i]));
  };
  return {
    rows,
    text: markdown(['times sooner', ...kSizes.map((n) => `${n}x${n}`)], lines),
    goals: [
      goal('convergence_advantage_growth_swing', growth('swing'), 'at-least', 1),
      goal('convergence_advantage_gathered', Math.min(...found[2]), 'at-least', 1),
    ],
  };
}

export function convergence({ repeat }) {
  const methods = [...kPlain, kHierarchical, kMultigrid];
  const rows = [
    ...solved('hang', 51, 'none', [pbd('jacobi'), ...methods, kLanes], repeat),
    ...solved('hang', 51, 'quadratic', [...methods, ...kSmoothings, ...kRatios], repeat),
    ...['swing', 'gathered'].flatMap((name) => solved(name, 51, 'quadratic', methods, repeat)),
  ];
  const main = rows.filter(({ scene, bending }) => scene === 'hang 51x51' && bending !== 'none');
  const of = (stepper) => main.filter(({ method }) => method.stepper === stepper);
  const ours = main.filter(({ label }) => label === 'multigrid');
  const bounds = { pbd: 0.5, hpbd: 0.8 };
  const goals = [1e-2, 1e-3].flatMap((error) =>
    Object.entries(bounds).map(([other, bound]) => {
      // What never came there within the rounds took longer than all of them.
      const theirs = Math.min(best(of(other), error), ...of(other).map(longest));
      const name = `convergence_${error.toExponential()}_of_${other}`;
      return goal(name, best(ours, error) / theirs, 'at-most', bound);
    }),
  );
  const distances = firstToDistance(repeat);
  const more = advantages(repeat);
  const head = [
    'step',
    'bending',
    'method',
    ...kErrors.map((error) => `ms (sweeps) to ${error}`),
    'last error',
  ];
  const texts = [markdown(head, linesOf(rows)), distances.text, more.text, drapes()];
  return {
    rows: [...rows, ...distances.rows, ...more.rows],
    goals: [...goals, ...more.goals],
    text: texts.join('\n\n'),
  };
}
