// ./pleat bench hard_cases (--help tells the options)
// Whether cloth stays cloth: hard cases, a minute of wind, a strain limit, and what a scene does not ask for.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

import { asset, shippedScene } from './parts/assets.mjs';
import { tell } from './parts/bench-options.mjs';
import { runParts } from './parts/bench-parts.mjs';
import { atLeast, atMost, described, markdown, measure, table } from './parts/bench-rows.mjs';
import { ask, askPage, inFolder, ran, reference } from './parts/command.mjs';
import { againstNewton, contestant } from './parts/contestants.mjs';
import { by, kCorners, kEdge, kStep, squareSheet } from './parts/sheets.mjs';

/** Every hard case with every stepper. */
const outcomes = (words) =>
  inFolder((folder) => {
    const file = join(folder, 'outcomes.jsonl');
    ran(['hard-cases', '--scenes', asset('hard_cases'), '--json', file, ...words]);
    const lines = readFileSync(file, 'utf8').trim().split('\n');
    return lines.map((line) => JSON.parse(line));
  });

/** How many outcomes have each status, and each that is not as it should be. */
function outcomeTables(rows, unexpected) {
  const statuses = [...new Set(rows.map((row) => row.status))];
  const having = (list, status) => list.filter((row) => row.status === status).length;
  const counts = statuses.map((of) => [of, having(rows, of), having(unexpected, of)]);
  const faults = unexpected.map(({ case: name, stepper, sentence }) => [name, stepper, sentence]);
  const tables = [markdown(['status', 'outcomes', 'unexpected'], counts)];
  if (faults.length) tables.push(markdown(['case', 'stepper', 'what was not kept'], faults));
  return tables.join('\n\n');
}

async function hardCases({ options }) {
  const rows = outcomes(options.short ? ['--short'] : []);
  const unexpected = rows.filter((row) => !row.expected);
  return {
    rows,
    goals: [atMost('unexpected_outcomes', unexpected.length, 0)],
    text: `what breaks cloth systems\n\n${outcomeTables(rows, unexpected)}`,
  };
}

const kSteppers = ['implicit', 'imex', 'newton', 'projective', 'xpbd'];

/** A run of the command, of which no frame is kept. */
const told = (scene) => ask('run', { ...scene, record: { format: 'none' } }, '--json');

/** The flag of 16x12 vertices for a minute in gusts, with every implicit stepper. */
async function flag({ repeat }) {
  const kSeconds = 60;
  const scene = shippedScene('flag');
  const scenes = Object.fromEntries(kSteppers.map((stepper) => [stepper, by(scene, { stepper })]));
  const rows = await againstNewton(scenes, scene, { repeat, frames: 30 });
  const runs = Object.entries(scenes).map(([stepper, one]) => {
    tell(`${kSeconds} s of ${stepper}`);
    const run = told({ ...one, duration_s: kSeconds });
    const isStable =
      run.n_steps === Math.round(kSeconds / kStep) &&
      run.warnings.every(({ kind }) => kind === 'not_converged');
    return { stepper, ...run, stable: isStable ? 'yes' : 'no' };
  });
  const columns = {
    stepper: 'stepper',
    status: 'status',
    s: 'time_s',
    'largest stretch %': (run) => 100 * run.largest_stretch,
    stable: 'stable',
  };
  const nStable = runs.filter(({ stable }) => stable === 'yes').length;
  return {
    rows,
    goals: [atLeast('flag_60_s_stable_steppers', nStable, kSteppers.length, rows)],
    text: `${table(runs, columns)}\n\n${described(rows)}`,
  };
}

/** A square soft enough to hang a third longer than it is. */
const softSheet = (stepper, strain_limit, { n = 33, pins = kEdge } = {}) => ({
  name: `soft sheet ${n}x${n}`,
  cloth: squareSheet(n, [-0.5, 1.5, 0], [0, -1, 0], [1, 0, 0]),
  fabric: {
    areal_density_kg_per_m2: 0.1,
    thickness_m: 3e-4,
    stretch_warp_n_per_m: 3,
    stretch_weft_n_per_m: 3,
    shear_n_per_m: 1,
    bend_warp_n_m: 1e-5,
    bend_weft_n_m: 1e-5,
    damping_ratio: 0.05,
  },
  model: strain_limit ? { strain_limit } : {},
  pins,
  method: { step_s: kStep, stepper },
  duration_s: 4,
});

const limits = {
  'no limit': null,
  'velocity constraint': { stretch: 0.1 },
  Provot: { stretch: 0.1, law: 'provot' },
};

/** Time over that of the scene without a limit, and the largest elongation, in 4 s. */
async function limited(repeat, stepper, sceneOf) {
  const scenes = Object.fromEntries(
    Object.entries(limits).map(([label, limit]) => [label, sceneOf(limit)]),
  );
  const exact = scenes['velocity constraint'];
  const rows = await againstNewton(scenes, exact, { repeat, frames: 240 });
  return rows.map((row, i) => {
    const [limit, scene] = Object.entries(scenes)[i];
    const run = told(scene);
    return {
      ...row,
      stepper,
      limit,
      elongation: run.largest_stretch,
      sweeps_per_step: run.strain_limit_sweeps_per_step ?? 0,
      n_capped: run.n_strain_limit_capped ?? 0,
    };
  });
}

async function limit({ repeat }) {
  const scenes = {
    ...Object.fromEntries(
      kSteppers
        .filter((stepper) => stepper !== 'newton')
        .map((stepper) => [stepper, (of) => softSheet(stepper, of)]),
    ),
    'implicit, 65x65': (of) => softSheet('implicit', of, { n: 65 }),
    'implicit, two corners': (of) => softSheet('implicit', of, { pins: kCorners }),
  };
  const rows = [];
  for (const [name, sceneOf] of Object.entries(scenes))
    rows.push(...(await limited(repeat, name, sceneOf)));
  const [free, held] = rows; // rows of implicit
  const { elongation, times_as_long_as_first: times } = held;
  const columns = {
    stepper: 'stepper',
    limit: 'limit',
    'time over unlimited': 'times_as_long_as_first',
    'largest elongation %': (row) => 100 * row.elongation,
    'sweeps a step': 'sweeps_per_step',
    'steps capped': 'n_capped',
  };
  return {
    rows,
    goals: [
      atMost('limit_largest_elongation', elongation, 0.1, [free, held]),
      atMost('limit_time_over_unlimited', times, 1.1, [free, held]),
    ],
    text: `${table(rows, columns)}\n\n${described(rows)}`,
  };
}

/** A plain scene against its stepper called on springs and weight with nothing around it, which runs twice. */
async function absent({ repeat }) {
  const times = [60 * kStep];
  const rows = [];
  const goals = [];
  const lines = [];
  for (const name of ['implicit', 'xpbd']) {
    const scene = { ...softSheet(name, null, { n: 65 }), model: { bending: 'none' } };
    const contestants = [
      contestant('bare', `${name}, the stepper alone`, scene),
      contestant('bare', `${name}, the stepper alone, again`, scene),
      contestant('native', `${name}, plain scene`, scene),
    ];
    const against = reference(scene, 'run', times);
    const found = await measure(contestants, { repeat, times, against, turnFrames: 1 });
    rows.push(...found);
    const [, again, plain] = found.map((row) => row.times_as_long_as_first);
    lines.push([name, again, plain]);
    goals.push(atMost(`absent_features_cost_${name}`, plain, 1.02, found));
  }
  const ratios = markdown(['stepper', 'alone, again', 'plain scene'], lines);
  const text = `time over that of the stepper alone\n\n${ratios}\n\n${described(rows)}`;
  return { rows, goals, text };
}

/** Motion on displays of several rates is the same to the bit, as the page paces it. */
async function display() {
  tell('flag on displays of several rates');
  const rows = askPage('display-rates');
  const isAsFirst = ({ sha256 }) => sha256 === rows[0].sha256;
  const nDiffering = rows.filter((row) => !isAsFirst(row)).length;
  const columns = {
    Hz: 'rate_hz',
    'positions after 1 s': (row) => row.sha256.slice(0, 12),
    'as at 30 Hz': (row) => (isAsFirst(row) ? 'yes' : 'no'),
  };
  const goals = [atMost('display_rates_that_differ', nDiffering, 0, rows)];
  return { rows, goals, text: table(rows, columns) };
}

const parts = { hard_cases: hardCases, flag, limit, absent, display };
const more = { '--short': 'hard cases in the lengths of tests' };
await runParts('hard_cases', 'whether cloth stays cloth, and what that costs', parts, { more });
