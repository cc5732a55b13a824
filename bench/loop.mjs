// ./pleat bench loop (--help tells the options)
// Speed and error of every stepper against each other, the same core as WebAssembly, and a plain
// JavaScript loop. Bounds in milliseconds hold where that loop (sheet 65x65, 100 substeps, row
// order) takes 20 ms, and are scaled by what it takes here.
import { shippedScene } from './parts/assets.mjs';
import { runParts } from './parts/bench-parts.mjs';
import { atLeast, atMost, measure, table } from './parts/bench-rows.mjs';
import { nativeRun, reference } from './parts/command.mjs';
import { contestant } from './parts/contestants.mjs';
import { loopContestant } from './parts/plain-loop.mjs';
import {
  by,
  cornersCome,
  cotton,
  kEdge,
  kLimp,
  kStep,
  lying,
  squareSheet,
} from './parts/sheets.mjs';

const kTimes = [0.5, 1]; // [s]

// Frames of a turn, by the vertices along a side: about 10 ms, in which caches are filled
// again soon and the machine's speed hardly changes.
const kTurnFrames = { 33: 30, 65: 8, 129: 2 };

/** A sheet let go from the horizontal, its upper edge held. Vertices are numbered as the loop's are. */
const swinging = (n, method) => by(cotton('swinging sheet', n, lying, kEdge, kLimp), method);

/** Rows of limp cloth against the chain of rigid links. */
const againstChain = (repeat, scene, contestants, more = {}) => {
  const { times = kTimes } = more;
  const against = reference(scene, 'rigid_chain', times);
  return measure(contestants, { repeat, times, against, ...more });
};

/**
 * 65x65 vertices hung by two corners that come together to half their distance within a second,
 * let go from the horizontal as the yardstick is, or hanging already.
 */
function cornersMeet(method, begin) {
  const warp = begin === 'horizontal' ? [0, 0, 1] : [0, -0.94, 0.342];
  const cloth = (n) => squareSheet(n, [-0.5, 1.5, 0], warp, [1, 0, 0]);
  const scene = cotton('corners meet', 65, cloth, cornersCome(0.25));
  return by({ ...scene, name: `${scene.name}, ${begin}` }, method);
}

/** xpbd in both builds and the loop in both orders, on n x n vertices. */
function yardstickRows(repeat, n, substeps) {
  const scene = swinging(n, { stepper: 'xpbd', substeps, iterations: 1, constraints: 'rigid' });
  const { masses_kg: masses } = nativeRun(scene, 2);
  const label = `xpbd, ${substeps} substeps`;
  const loop = (order) =>
    loopContestant(scene.name, n, substeps, { name: `yardstick ${order}`, order, masses });
  const contestants = [
    ...['wasm', 'native'].map((target) => contestant(target, label, scene)),
    ...['rows', 'coloured'].map(loop),
  ];
  return againstChain(repeat, scene, contestants, { turnFrames: kTurnFrames[n] });
}

/** Three and four times as fast as the loop, and as right as the better of its orders. */
function yardstickGoals(name, [ours, , byRows, coloured]) {
  const faster = (order, row, bound) =>
    atLeast(`${name}_times_faster_than_${order}`, row.times_as_long_as_first, bound, [ours, row]);
  const noLarger = (what, of) => {
    const bound = Math.min(of(byRows), of(coloured));
    return atMost(`${name}_${what}`, of(ours), bound, [ours, byRows, coloured]);
  };
  return [
    faster('rows', byRows, 4),
    faster('coloured', coloured, 3),
    noLarger('rms_stretch', (row) => row.rms_stretch),
    noLarger('largest_stretch', (row) => row.largest_stretch),
    ...kTimes.map((time) =>
      noLarger(`position_error_m_at_${time}_s`, (row) => row.position_errors_m[`${time} s`]),
    ),
  ];
}

/** xpbd against the yardstick: same substeps, constraints and masses, no bending, compliance 0. */
async function yardstick({ repeat }) {
  const rows = [];
  const goals = [];
  for (const n of [33, 65, 129]) {
    for (const substeps of [30, 100]) {
      const found = await yardstickRows(repeat, n, substeps);
      rows.push(...found);
      goals.push(...yardstickGoals(`xpbd_${n}_${substeps}`, found));
    }
  }
  return { rows, goals };
}

function projectiveGoals(begin, scale, [ours, , implicitRow]) {
  const stretch = 100 * ours.rms_stretch_worst_frame;
  const both = [ours, implicitRow];
  const [error, most] = both.map((row) => row.position_error_m);
  return [
    atMost(`projective_rms_stretch_percent_${begin}`, stretch, 0.4, [ours]),
    atMost(`projective_ms_per_frame_wasm_${begin}`, ours.ms_per_frame, 6 * scale, [ours]),
    atMost(`projective_position_error_m_at_1_s_${begin}`, error, most, both),
  ];
}

async function projective({ repeat, scale }) {
  const times = [1];
  // One round in each of ten substeps: more substeps answer sooner than more rounds.
  const method = { stepper: 'projective', substeps: 10, iterations: 1 };
  const coarse = { stepper: 'implicit', solver: 'cholmod', substeps: 1 };
  const label = 'projective, 10 substeps of 1 round';
  const rows = [];
  const goals = [];
  for (const begin of ['horizontal', 'hanging']) {
    const fine = cornersMeet({ ...coarse, substeps: 16 }, begin);
    const contestants = [
      ...['wasm', 'native'].map((target) => contestant(target, label, cornersMeet(method, begin))),
      contestant('native', 'implicit, 1/60 s', cornersMeet(coarse, begin)),
    ];
    const against = reference(fine, 'run', times);
    const found = await measure(contestants, { repeat, times, against });
    rows.push(...found);
    goals.push(...projectiveGoals(begin, scale, found));
  }
  return { rows, goals };
}

/**
 * Few accelerated rounds of projective against many plain ones, on cloth that swings. Errors are
 * those of all frames together, as in sweeps, and the frames end before the free edge whips round.
 */
async function acceleration({ repeat }) {
  const scene = shippedScene('swinging_sheet');
  const frames = 24;
  const times = Array.from({ length: frames }, (_, k) => (k + 1) * kStep);
  const rounds = (iterations, kind) => {
    const label = `projective, ${iterations} rounds, acceleration: ${kind}`;
    const method = { stepper: 'projective', substeps: 1, iterations, acceleration: kind };
    return contestant('native', label, by(scene, method), frames);
  };
  const exact = { stepper: 'newton', step_s: kStep / 16, rule: 'midpoint' };
  const against = reference(by(scene, exact), 'run', times);
  const contestants = [rounds(40, 'none'), rounds(5, 'anderson')];
  const rows = await measure(contestants, { repeat, times, against, frames, turnFrames: 6 });
  const error = (row) => Math.hypot(...Object.values(row.position_errors_m)) / Math.sqrt(frames);
  const [plain, accelerated] = rows;
  const columns = {
    contestant: 'label',
    'ms/frame': 'ms_per_frame',
    spread: 'spread_ms',
    'error of all frames mm': (row) => 1e3 * error(row),
    'of the last': (row) => 1e3 * row.position_error_m,
    status: 'status',
  };
  const time = accelerated.times_as_long_as_first;
  return {
    rows,
    goals: [
      atMost('accelerated_rounds_time_to_plain', time, 1 / 3, rows),
      atMost('accelerated_rounds_error_to_plain', error(accelerated) / error(plain), 1, rows),
    ],
    text: `errors against ${against.reference.description}\n\n${table(rows, columns)}`,
  };
}

async function implicit({ repeat, scale }) {
  const method = (more) => swinging(100, { stepper: 'implicit', substeps: 1, ...more });
  const scenes = {
    'cg to 1e-2': method({ solver: 'cg', tolerance: 1e-2 }),
    'cg to 1e-3': method({ solver: 'cg', tolerance: 1e-3 }),
    cholmod: method({ solver: 'cholmod' }),
  };
  const contestants = Object.entries(scenes).map(([solver, scene]) =>
    contestant('native', `implicit, ${solver}`, scene),
  );
  const rows = await againstChain(repeat, scenes['cg to 1e-2'], contestants);
  const [row] = rows;
  const goals = [atMost('implicit_100x100_cg_1e-2_ms_native', row.ms_per_frame, 60 * scale, [row])];
  return { rows, goals };
}

/** The float64 steppers in both builds on the same scene. */
async function targets({ repeat }) {
  const methods = {
    explicit: { stepper: 'explicit', substeps: 'stable' },
    implicit_cg: { stepper: 'implicit', substeps: 1, solver: 'cg', tolerance: 1e-3 },
    implicit_cholmod: { stepper: 'implicit', substeps: 1, solver: 'cholmod' },
    projective: { stepper: 'projective', substeps: 1, iterations: 10, solver: 'cholmod' },
  };
  const rows = [];
  const goals = [];
  for (const [name, method] of Object.entries(methods)) {
    const scene = swinging(33, method);
    // A frame of explicit is 12 000 substeps.
    const [frames, times] = name === 'explicit' ? [6, [0.1]] : [60, kTimes];
    const both = ['native', 'wasm'].map((target) => contestant(target, name, scene, frames));
    const found = await againstChain(repeat, scene, both, { frames, times, turnFrames: 1 });
    rows.push(...found);
    goals.push(atMost(`wasm_over_native_${name}`, found[1].times_as_long_as_first, 2, found));
  }
  return { rows, goals };
}

/**
 * A scene pays nothing for what it does not ask for: a frame of springs and weight alone takes no
 * longer than the stepper called on them with nothing around it.
 */
async function absent({ repeat }) {
  const n = 65;
  const kNoise = 1.05; // interleaved medians differ by less
  const methods = {
    xpbd: { stepper: 'xpbd', substeps: 30, iterations: 1 },
    implicit: { stepper: 'implicit', substeps: 1, solver: 'cg', tolerance: 1e-2 },
  };
  const rows = [];
  const goals = [];
  for (const [name, method] of Object.entries(methods)) {
    const scene = swinging(n, method);
    const both = [
      contestant('bare', `${name}, the stepper alone`, scene),
      contestant('native', `${name}, plain scene`, scene),
    ];
    const found = await againstChain(repeat, scene, both, { turnFrames: kTurnFrames[n] });
    rows.push(...found);
    const ratio = found[1].times_as_long_as_first;
    goals.push(atMost(`absent_features_cost_${name}`, ratio, kNoise, found));
  }
  return { rows, goals };
}

const parts = { yardstick, projective, acceleration, implicit, targets, absent };
await runParts('loop', 'speed and error, and the goals they have to meet', parts);
