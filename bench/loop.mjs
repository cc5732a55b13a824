// ./pleat bench loop (--help tells the options)
// Speed and error of every stepper against each other, the same core as WebAssembly, and a plain
// JavaScript loop. Bounds in milliseconds hold where that loop (sheet 65x65, 100 substeps, row
// order) takes 20 ms, and are scaled by what it takes here.
import { commit, runParts, tell } from './parts/bench-parts.mjs';
import { goal, measure } from './parts/bench-rows.mjs';
import { nativeRun, reference } from './parts/command.mjs';
import { contestant as contestantOf, yardstickTurns } from './parts/contestants.mjs';
import { squareSheet } from './parts/square-sheet.mjs';

const kFrames = 60; // one second, the stretch of motion that positions are compared over
const kStep = 1 / 60; // [s]
const kTimes = [0.5, 1]; // [s]

// Frames of a turn, by the vertices along a side: about 10 ms, in which caches are filled
// again soon and the machine's speed hardly changes.
const kTurnFrames = { 33: 30, 65: 8, 129: 2 };

// Cloth without bending is what the chain of rigid links is the limit of.
const kLimp = { model: { bending: 'none' } };

/** How the rows of a part are measured: `repeat` rounds, positions at `times` [s]. */
const settings = (repeat, times) => ({ repeat, times, commit, tell });

/**
 * A sheet of n x n vertices let go from the horizontal, its upper edge held. Vertices are numbered
 * as the yardstick's are.
 */
function swingingSheet(n, method, more = {}) {
  return {
    name: `swinging sheet ${n}x${n}`,
    cloth: squareSheet(n, [0, 0, 0], [0, 0, 1], [1, 0, 0]),
    fabric: { name: 'fine cotton' },
    pins: [{ part: 'upper_edge' }],
    method: { step_s: kStep, ...method },
    duration_s: 1,
    ...more,
  };
}

/**
 * 65x65 vertices hung by two corners that come together to half their distance within a second,
 * let go from the horizontal as the yardstick is, or hanging already.
 */
function cornersMeet(method, begin = 'horizontal') {
  const comeTogether = (offset) => ({
    kind: 'ease',
    offset_m: [offset, 0, 0],
    begin_s: 0,
    end_s: 1,
  });
  const warp = begin === 'horizontal' ? [0, 0, 1] : [0, -0.94, 0.342];
  return {
    name: `corners meet 65x65, ${begin}`,
    cloth: squareSheet(65, [-0.5, 1.5, 0], warp, [1, 0, 0]),
    fabric: { name: 'fine cotton' },
    pins: [
      { part: 'upper_left', motion: comeTogether(0.25) },
      { part: 'upper_right', motion: comeTogether(-0.25) },
    ],
    method: { step_s: kStep, ...method },
    duration_s: 1,
  };
}

const contestant = (target, label, scene, n, frames = kFrames) =>
  contestantOf(target, label, scene, n * n, frames);

function yardstick(n, substeps, order, masses) {
  return {
    label: `swinging sheet ${n}x${n}, yardstick ${order}, ${substeps} substeps`,
    scene: `swinging sheet ${n}x${n}`,
    method: { stepper: `yardstick ${order}`, step_s: kStep, substeps },
    n_vertices: n * n,
    begin: (times) => yardstickTurns(n, substeps, order, kFrames, times, masses),
  };
}

/** xpbd in both builds and the loop in both orders, on n x n vertices. */
async function yardstickRows(repeat, n, substeps) {
  const method = { stepper: 'xpbd', substeps, iterations: 1, constraints: 'rigid' };
  const scene = swingingSheet(n, method, kLimp);
  const { masses_kg: masses } = nativeRun(scene, 2);
  const label = `xpbd, ${substeps} substeps`;
  return measure(
    [
      contestant('wasm', label, scene, n),
      contestant('native', label, scene, n),
      yardstick(n, substeps, 'rows', masses),
      yardstick(n, substeps, 'coloured', masses),
    ],
    {
      ...settings(repeat, kTimes),
      against: reference(scene, 'rigid_chain', kTimes),
      turnFrames: kTurnFrames[n],
    },
  );
}

/** Three and four times as fast as the loop, and as right as the better of its orders. */
function yardstickGoals(name, [ours, , byRows, coloured]) {
  const faster = (order, row, bound) =>
    goal(`${name}_times_faster_than_${order}`, row.times_as_long_as_first, 'at-least', bound, [
      ours,
      row,
    ]);
  const noLarger = (what, measureOf) =>
    goal(
      `${name}_${what}`,
      measureOf(ours),
      'at-most',
      Math.min(measureOf(byRows), measureOf(coloured)),
      [ours, byRows, coloured],
    );
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
async function againstYardstick({ repeat }) {
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
  return [
    goal(
      `projective_rms_stretch_percent_${begin}`,
      100 * ours.rms_stretch_worst_frame,
      'at-most',
      0.4,
      [ours],
    ),
    goal(`projective_ms_per_frame_wasm_${begin}`, ours.ms_per_frame, 'at-most', 6 * scale, [ours]),
    goal(
      `projective_position_error_m_at_1_s_${begin}`,
      ours.position_error_m,
      'at-most',
      implicitRow.position_error_m,
      [ours, implicitRow],
    ),
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
    const found = await measure(
      [
        contestant('wasm', label, cornersMeet(method, begin), 65),
        contestant('native', label, cornersMeet(method, begin), 65),
        contestant('native', 'implicit, 1/60 s', cornersMeet(coarse, begin), 65),
      ],
      { ...settings(repeat, times), against: reference(fine, 'run', times) },
    );
    rows.push(...found);
    goals.push(...projectiveGoals(begin, scale, found));
  }
  return { rows, goals };
}

async function implicit({ repeat, scale }) {
  const n = 100;
  const method = (more) => swingingSheet(n, { stepper: 'implicit', substeps: 1, ...more }, kLimp);
  const loose = method({ solver: 'cg', tolerance: 1e-2 });
  const rows = await measure(
    [
      contestant('native', 'implicit, cg to 1e-2', loose, n),
      contestant('native', 'implicit, cg to 1e-3', method({ solver: 'cg', tolerance: 1e-3 }), n),
      contestant('native', 'implicit, cholmod', method({ solver: 'cholmod' }), n),
    ],
    { ...settings(repeat, kTimes), against: reference(loose, 'rigid_chain', kTimes) },
  );
  return {
    rows,
    goals: [
      goal('implicit_100x100_cg_1e-2_ms_native', rows[0].ms_per_frame, 'at-most', 60 * scale, [
        rows[0],
      ]),
    ],
  };
}

/** The float64 steppers in both builds on the same scene. */
async function targets({ repeat }) {
  const n = 33;
  const methods = {
    explicit: { stepper: 'explicit', substeps: 'stable' },
    implicit_cg: { stepper: 'implicit', substeps: 1, solver: 'cg', tolerance: 1e-3 },
    implicit_cholmod: { stepper: 'implicit', substeps: 1, solver: 'cholmod' },
    projective: { stepper: 'projective', substeps: 1, iterations: 10, solver: 'cholmod' },
  };
  const rows = [];
  const goals = [];
  for (const [name, method] of Object.entries(methods)) {
    const scene = swingingSheet(n, method, kLimp);
    const frames = name === 'explicit' ? 6 : kFrames; // of 12 000 substeps each
    const times = name === 'explicit' ? [0.1] : kTimes;
    const found = await measure(
      [contestant('native', name, scene, n, frames), contestant('wasm', name, scene, n, frames)],
      {
        ...settings(repeat, times),
        against: reference(scene, 'rigid_chain', times),
        frames,
        turnFrames: 1,
      },
    );
    rows.push(...found);
    const ratio = found[1].times_as_long_as_first;
    goals.push(goal(`wasm_over_native_${name}`, ratio, 'at-most', 2, found));
  }
  return { rows, goals };
}

/**
 * What a scene does not ask for costs nothing: a frame of springs and weight alone takes no longer
 * than the stepper called on them with nothing around it.
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
    const scene = swingingSheet(n, method, kLimp);
    const found = await measure(
      [
        contestant('bare', `${name}, the stepper alone`, scene, n),
        contestant('native', `${name}, plain scene`, scene, n),
      ],
      {
        ...settings(repeat, kTimes),
        against: reference(scene, 'rigid_chain', kTimes),
        turnFrames: kTurnFrames[n],
      },
    );
    rows.push(...found);
    const ratio = found[1].times_as_long_as_first;
    goals.push(goal(`absent_features_cost_${name}`, ratio, 'at-most', kNoise, found));
  }
  return { rows, goals };
}

await runParts('loop', 'speed and error, and the goals they have to meet', {
  yardstick: againstYardstick,
  projective,
  implicit,
  targets,
  absent,
});
