// Position-based steppers against a plain JavaScript loop: the cheapest setting that stretches no more.
import { commit, described, tell } from './bench-parts.mjs';
import { goal, hasFinished, measure } from './bench-rows.mjs';
import { nativeRun, reference } from './command.mjs';
import { contestant } from './contestants.mjs';
import { loopTurns } from './loop-scenes.mjs';
import { squareSheet } from './square-sheet.mjs';

const kFrames = 60; // one second
const kStep = 1 / 60; // [s]
const kTimes = [0.5, 1]; // [s]

/** Rigid links, no bending: what the loop computes. */
function limpSheet(name, n, cloth, pins, more = {}) {
  return {
    name: `${name} ${n}x${n}`,
    cloth,
    fabric: { name: 'fine cotton' },
    model: { bending: 'none' },
    pins,
    duration_s: 1,
    ...more,
  };
}

const kCorners = [{ part: 'upper_left' }, { part: 'upper_right' }];
const lying = (u, v) => [u, 0, v];
const upright = (u, v) => [u, -v, 0];
const kMeet = 0.25; // how far each corner goes [m]

/** 0 to 1 in a second as motions of kind "ease" go. */
const ease = (time) => {
  const t = Math.min(time, 1);
  return t * t * (3 - 2 * t);
};

const kBall = { centre: [0.5, -0.35, 0.5], radius: 0.3, friction: 0.3 };

/** Scenes of both: ours, and what the loop has to know. */
const kScenes = {
  swing_edge: {
    ours: (n) =>
      limpSheet('swing by an edge', n, squareSheet(n, [0, 0, 0], [0, 0, 1], [1, 0, 0]), [
        { part: 'upper_edge' },
      ]),
    loop: { pins: 'edge', placeOf: lying },
    hasReference: true,
  },
  swing_corners: {
    ours: (n) =>
      limpSheet(
        'swing by two corners',
        n,
        squareSheet(n, [0, 0, 0], [0, 0, 1], [1, 0, 0]),
        kCorners,
      ),
    loop: { pins: 'corners', placeOf: lying },
  },
  hang_corners: {
    ours: (n) =>
      limpSheet(
        'hang by two corners',
        n,
        squareSheet(n, [0, 0, 0], [0, -1, 0], [1, 0, 0]),
        kCorners,
      ),
    loop: { pins: 'corners', placeOf: upright },
  },
  ball: {
    ours: (n) =>
      limpSheet('fall on a ball', n, squareSheet(n, [0, 0, 0], [0, 0, 1], [1, 0, 0]), [], {
        world: {
          colliders: [
            {
              sphere: { centre_m: kBall.centre, radius_m: kBall.radius },
              friction: kBall.friction,
            },
          ],
        },
      }),
    loop: { pins: 'none', placeOf: lying, ball: kBall },
  },
  gathered: {
    ours: (n) => {
      const comes = (x) => ({ kind: 'ease', offset_m: [x, 0, 0], begin_s: 0, end_s: 1 });
      return limpSheet('gather', n, squareSheet(n, [0, 0, 0], [0, -1, 0], [1, 0, 0]), [
        { part: 'upper_left', motion: comes(kMeet) },
        { part: 'upper_right', motion: comes(-kMeet) },
      ]);
    },
    loop: { pins: 'corners', placeOf: upright, pinsMove: (time) => kMeet * ease(time) },
  },
};

const kLoopSubsteps = [30, 100, 300];
const kTurnFrames = 4;
/** From few substeps to many: what comes first that is good enough is the cheapest of its kind. */
const kCandidates = {
  xpbd: [5, 10, 20, 30, 50, 100, 200].map((substeps) => ({
    stepper: 'xpbd',
    constraints: 'rigid',
    substeps,
  })),
  multigrid: [3, 5, 7, 10, 15, 20, 30, 45, 60, 90].flatMap((substeps) =>
    [
      {},
      { smoother_before: 'gauss_seidel' },
      { attachments: 'none' },
      { levels: 1 },
      { levels: 0 },
    ].map((more) => ({ stepper: 'multigrid', substeps, ...more })),
  ),
};

const labelOf = ({ stepper, constraints, substeps, levels, ...more }) =>
  [
    stepper,
    `${substeps} substeps`,
    ...(levels === undefined ? [] : [`${levels} levels`]),
    ...Object.entries(more).map(([key, word]) => `${key} ${word}`),
  ].join(', ');

async function rowOf(candidate, settings) {
  const [row] = await measure([candidate], { ...settings, repeat: 1 });
  return row;
}

/** The cheapest of a stepper's settings that is no worse than the loop, as measured once; null without one. */
async function cheapest(scene, n, methods, loop, settings, hasReference) {
  const isGoodEnough = (row) =>
    hasFinished(row) &&
    row.rms_stretch <= loop.rms_stretch &&
    (!hasReference || row.position_error_m <= loop.position_error_m);
  let best = null;
  for (const method of methods) {
    const ours = contestant(
      'wasm',
      labelOf(method),
      { ...scene, method: { step_s: kStep, ...method } },
      n * n,
      kFrames,
    );
    const row = await rowOf(ours, settings);
    if (isGoodEnough(row) && (best === null || row.ms_per_frame < best.row.ms_per_frame))
      best = { ours, row };
  }
  return best;
}

/** Rows of one scene on n x n vertices, and how many times as fast as the loop the best setting is. */
async function contest(name, n, repeat) {
  const { ours, loop, hasReference } = kScenes[name];
  const scene = ours(n);
  const plain = { ...scene, method: { step_s: kStep, stepper: 'xpbd', constraints: 'rigid' } };
  const { masses_kg: masses } = nativeRun(plain, 2);
  const kind = hasReference ? 'rigid_chain' : 'run';
  const settings = { times: kTimes, commit, tell, against: reference(plain, kind, kTimes) };
  const rows = [];
  const ratios = { best: [], xpbd: [] };
  for (const substeps of kLoopSubsteps) {
    const theirs = {
      label: `${scene.name}, loop, ${substeps} substeps`,
      scene: scene.name,
      method: { stepper: 'loop', step_s: kStep, substeps },
      n_vertices: n * n,
      begin: (times) => loopTurns(n, { ...loop, masses }, substeps, kFrames, times),
    };
    const once = await rowOf(theirs, settings);
    const found = {};
    for (const [stepper, methods] of Object.entries(kCandidates))
      found[stepper] = await cheapest(scene, n, methods, once, settings, hasReference);
    const taken = Object.entries(found).filter(([, best]) => best !== null);
    const measured = await measure([theirs, ...taken.map(([, best]) => best.ours)], {
      ...settings,
      repeat,
      turnFrames: kTurnFrames,
    });
    rows.push(...measured);
    const times = (stepper) => {
      const at = taken.findIndex(([one]) => one === stepper);
      return at < 0 ? 0 : measured[0].ms_per_frame / measured[at + 1].ms_per_frame;
    };
    ratios.xpbd.push(times('xpbd'));
    ratios.best.push(Math.max(times('xpbd'), times('multigrid')));
  }
  return { rows, best: Math.min(...ratios.best), xpbd: Math.min(...ratios.xpbd) };
}

/** How many times as fast as the loop, where it is promised. */
function promised(name, n) {
  const swings = name.startsWith('swing');
  if (swings && n === 129) return 25;
  return swings && n === 65 ? 10 : 5;
}

/**
 * The worst of three numbers of the loop's substeps counts. Where no reference is known, stretch
 * alone is compared: errors in those rows are distances from another run.
 */
export async function loop({ repeat, options }) {
  const rows = [];
  const goals = [];
  const sizes = options.vertices ? [Number(options.vertices)] : [33, 65, 129];
  for (const name of Object.keys(kScenes)) {
    if (!name.includes(options.scene ?? '')) continue;
    for (const n of sizes) {
      const { rows: found, best, xpbd } = await contest(name, n, repeat);
      rows.push(...found);
      goals.push(
        goal(`loop_${name}_${n}_times_faster`, best, 'at-least', promised(name, n), found),
      );
      goals.push({
        name: `loop_${name}_${n}_xpbd`,
        ok: true,
        line: `shown loop_${name}_${n}_xpbd_times_faster ${xpbd.toPrecision(3)}`,
      });
    }
  }
  return { rows, goals, text: described(rows) };
}

export const loopOptions = [
  { name: 'scene', type: 'string', usage: '--scene TEXT     loop: scenes with this in their name' },
  { name: 'vertices', type: 'string', usage: '--vertices N     loop: sheets of N x N alone' },
];
