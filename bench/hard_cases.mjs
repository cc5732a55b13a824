// ./pleat bench hard_cases (--help tells the options)
// Whether cloth stays cloth: hard cases, a minute of wind, a strain limit, and what a scene does not ask for.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

import { commit, described, runParts, tell } from './parts/bench-parts.mjs';
import { goal, markdown, measure, short } from './parts/bench-rows.mjs';
import { ask, askPage, reference, root } from './parts/command.mjs';
import { contestant } from './parts/contestants.mjs';
import { hardCases } from './parts/hard-cases.mjs';
import { squareSheet } from './parts/square-sheet.mjs';

const kStep = 1 / 60; // [s]

const shipped = (name) =>
  JSON.parse(readFileSync(join(root, 'assets', 'scenes', `${name}.json`), 'utf8'));

const implicitMethods = {
  implicit: { stepper: 'implicit' },
  imex: { stepper: 'imex' },
  newton: { stepper: 'newton' },
  projective: { stepper: 'projective' },
  xpbd: { stepper: 'xpbd' },
};

/**
 * Contestants in turn, against `newton` with 16 steps a frame.
 *
 * sceneOf: (method, limit) => scene; entries: {label: scene}
 */
function compared({ repeat, exact, scenes, vertices, frames }) {
  const times = [(frames * kStep) / 2, frames * kStep];
  tell(`reference of ${exact.name}`);
  const against = reference(
    { ...exact, method: { stepper: 'newton', step_s: kStep / 16 } },
    'run',
    times,
  );
  const contestants = Object.entries(scenes).map(([label, scene]) =>
    contestant('native', label, scene, vertices, frames),
  );
  return measure(contestants, { repeat, times, commit, tell, against, frames, turnFrames: 5 });
}

/** The flag of 16x12 vertices for a minute in gusts, with every implicit stepper. */
async function flag({ repeat }) {
  const kSeconds = 60;
  const scene = shipped('flag');
  const scenes = Object.fromEntries(
    Object.entries(implicitMethods).map(([name, method]) => [
      name,
      { ...scene, method: { step_s: kStep, ...method } },
    ]),
  );
  const rows = await compared({ repeat, exact: scene, scenes, vertices: 192, frames: 30 });
  const lines = [];
  let stable = 0;
  for (const [name, one] of Object.entries(scenes)) {
    tell(`${kSeconds} s of ${name}`);
    const run = ask('run', { ...one, duration_s: kSeconds, record: { format: 'none' } }, '--json');
    const isStable =
      run.n_steps === Math.round(kSeconds / kStep) &&
      run.warnings.every(({ kind }) => kind === 'not_converged');
    if (isStable) ++stable;
    lines.push([
      name,
      run.status,
      short(run.time_s),
      short(100 * run.largest_stretch),
      isStable ? 'yes' : 'no',
    ]);
  }
  const text = `${markdown(['stepper', 'status', 's', 'largest stretch %', 'stable'], lines)}\n\n${described(rows)}`;
  const n = Object.keys(scenes).length;
  return {
    rows,
    goals: [goal('stability.flag_60_s_stable_steppers', stable, 'at-least', n, rows)],
    text,
  };
}

/** A square of 33x33 vertices, soft enough to hang a third longer than it is. */
const softSheet = (method, strain_limit, { n = 33, pins = [{ part: 'upper_edge' }] } = {}) => ({
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
  method: { step_s: kStep, ...method },
  duration_s: 4,
});

const limits = {
  'no limit': null,
  'velocity constraint': { stretch: 0.1 },
  Provot: { stretch: 0.1, law: 'provot' },
};

/** Time over that of the scene without a limit, and the largest elongation, in 4 s. */
async function limited(repeat, sceneOf, vertices) {
  const scenes = Object.fromEntries(
    Object.entries(limits).map(([label, limit]) => [label, sceneOf(limit)]),
  );
  const frames = 240;
  const rows = await compared({
    repeat,
    exact: sceneOf(limits['velocity constraint']),
    scenes,
    vertices,
    frames,
  });
  return rows.map((row, i) => {
    const run = ask('run', { ...Object.values(scenes)[i], record: { format: 'none' } }, '--json');
    return {
      ...row,
      elongation: run.largest_stretch,
      sweeps_per_step: run.strain_limit_sweeps_per_step ?? 0,
      n_capped: run.n_strain_limit_capped ?? 0,
    };
  });
}

async function limit({ repeat }) {
  const rows = [];
  const goals = [];
  const lines = [];
  const scenes = [
    ...Object.keys(implicitMethods)
      .filter((name) => name !== 'newton')
      .map((name) => [name, (limit) => softSheet(implicitMethods[name], limit), 33 * 33]),
    ['implicit, 65x65', (limit) => softSheet(implicitMethods.implicit, limit, { n: 65 }), 65 * 65],
    [
      'implicit, two corners',
      (limit) =>
        softSheet(implicitMethods.implicit, limit, {
          pins: [{ part: 'upper_left' }, { part: 'upper_right' }],
        }),
      33 * 33,
    ],
  ];
  for (const [name, sceneOf, vertices] of scenes) {
    const found = await limited(repeat, sceneOf, vertices);
    rows.push(...found);
    for (const [i, label] of Object.keys(limits).entries()) {
      const row = found[i];
      const numbers = [
        row.times_as_long_as_first,
        100 * row.elongation,
        row.sweeps_per_step,
        row.n_capped,
      ];
      lines.push([name, label, ...numbers.map(short)]);
    }
    if (name !== 'implicit') continue;
    const judged = found.slice(0, 2);
    goals.push(
      goal('stability.limit_largest_elongation', found[1].elongation, 'at-most', 0.1, judged),
      goal(
        'stability.limit_time_over_unlimited',
        found[1].times_as_long_as_first,
        'at-most',
        1.1,
        judged,
      ),
    );
  }
  const head = [
    'stepper',
    'limit',
    'time over unlimited',
    'largest elongation %',
    'sweeps a step',
    'steps capped',
  ];
  return { rows, goals, text: `${markdown(head, lines)}\n\n${described(rows)}` };
}

/** A plain scene against its stepper called on springs and weight with nothing around it, which runs twice. */
async function absent({ repeat }) {
  const n = 65;
  const kFrames = 60;
  const times = [kFrames * kStep];
  const rows = [];
  const goals = [];
  const lines = [];
  for (const name of ['implicit', 'xpbd']) {
    const scene = {
      ...softSheet(implicitMethods[name], null, { n }),
      model: { bending: 'none' },
    };
    const against = reference(scene, 'run', times);
    const found = await measure(
      [
        contestant('bare', `${name}, the stepper alone`, scene, n * n, kFrames),
        contestant('bare', `${name}, the stepper alone, again`, scene, n * n, kFrames),
        contestant('native', `${name}, plain scene`, scene, n * n, kFrames),
      ],
      { repeat, times, commit, tell, against, frames: kFrames, turnFrames: 1 },
    );
    rows.push(...found);
    const [, again, plain] = found.map((row) => row.times_as_long_as_first);
    lines.push([name, short(again), short(plain)]);
    goals.push(goal(`stability.absent_features_cost_${name}`, plain, 'at-most', 1.02, found));
  }
  const head = ['stepper', 'alone, again', 'plain scene'];
  return {
    rows,
    goals,
    text: `time over that of the stepper alone\n\n${markdown(head, lines)}\n\n${described(rows)}`,
  };
}

/** Motion on displays of several rates is the same to the bit, as the page paces it. */
async function display() {
  tell('flag on displays of several rates');
  const rows = askPage('display-rates');
  const isAsFirst = ({ sha256 }) => sha256 === rows[0].sha256;
  const differing = rows.filter((row) => !isAsFirst(row)).length;
  const lines = rows.map((row) => [
    row.rate_hz,
    row.sha256.slice(0, 12),
    isAsFirst(row) ? 'yes' : 'no',
  ]);
  return {
    rows,
    goals: [goal('stability.display_rates_that_differ', differing, 'at-most', 0, rows)],
    text: markdown(['Hz', 'positions after 1 s', 'as at 30 Hz'], lines),
  };
}

await runParts(
  'hard_cases',
  'whether cloth stays cloth, and what that costs',
  { hard_cases: hardCases, flag, limit, absent, display },
  [
    {
      name: 'short',
      type: 'boolean',
      usage: '--short           hard cases in the lengths of tests',
    },
  ],
);
