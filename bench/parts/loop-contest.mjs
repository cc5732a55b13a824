// Steppers against a plain JavaScript loop: the cheapest setting that stretches no more.
import { commit, described, tell } from './bench-parts.mjs';
import { goal, hasFinished, measure } from './bench-rows.mjs';
import { nativeRun, reference } from './command.mjs';
import { contestant } from './contestants.mjs';
import { kScenes } from './loop-scenes.mjs';
import { loopTurns } from './plain-loop.mjs';

const kFrames = 60; // one second
const kStep = 1 / 60; // [s]
const kTimes = [0.5, 1]; // [s]

const kLoopSubsteps = [30, 100, 300];
const kTurnFrames = 4;
/** With more, the noise of projections grows. */
const kCarried = 0.3;
const kCandidates = {
  xpbd: [
    5, 7, 8, 9, 10, 11, 12, 14, 17, 20, 23, 26, 30, 40, 50, 60, 70, 85, 100, 140, 200, 220, 250,
    300,
  ].map((substeps) => ({
    stepper: 'xpbd',
    constraints: 'rigid',
    substeps,
  })),
  multigrid: [
    ...[4, 5, 6, 7, 8, 9, 10, 12, 15, 20, 25, 30, 45, 60, 90].flatMap((substeps) =>
      [
        {},
        { smoother_before: 'none' },
        { smoother_before: 'none', levels: 0 },
        { carried_acceleration: kCarried },
        { carried_acceleration: kCarried, levels: 0 },
        { carried_acceleration: kCarried, smoother_before: 'none', levels: 0 },
        { smoother_before: 'gauss_seidel', smoother: 'gauss_seidel' },
        { smoother_before: 'none', smoother: 'gauss_seidel', levels: 0 },
      ].map((more) => ({ substeps, ...more })),
    ),
    // Without pins: sweeps of xpbd whose diagonals give way.
    ...[17, 40, 50, 75, 120, 140, 170, 200].flatMap((substeps) =>
      [{}, { carried_acceleration: kCarried }].map((more) => ({
        substeps,
        ...more,
        smoother_before: 'none',
        levels: 0,
      })),
    ),
  ].map((more) => ({ stepper: 'multigrid', ...more })),
  // Springs of the fabric, for cloth that folds where no rigid link lets it.
  projective: [
    { substeps: 1, iterations: 3 },
    { substeps: 1 },
    { substeps: 2, iterations: 3 },
    { substeps: 4, iterations: 3 },
  ].map((more) => ({ stepper: 'projective', ...more })),
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

/** Contestants with these settings, each with the row of a single run. */
async function candidatesOf(scene, n, methods, settings) {
  const candidates = [];
  for (const method of methods) {
    const ours = contestant(
      'wasm',
      labelOf(method),
      { ...scene, method: { step_s: kStep, ...method } },
      n * n,
      kFrames,
    );
    candidates.push({ ours, row: await rowOf(ours, settings) });
  }
  return candidates;
}

/** The cheapest that is no worse than the loop, as measured once; null without one. */
function cheapest(candidates, loop, hasReference) {
  const isGoodEnough = ({ row }) =>
    hasFinished(row) &&
    row.rms_stretch <= loop.rms_stretch &&
    (!hasReference || row.position_error_m <= loop.position_error_m);
  return candidates
    .filter(isGoodEnough)
    .reduce(
      (best, one) => (best && best.row.ms_per_frame <= one.row.ms_per_frame ? best : one),
      null,
    );
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
  const candidates = {};
  for (const [stepper, methods] of Object.entries(kCandidates))
    candidates[stepper] = await candidatesOf(scene, n, methods, settings);
  for (const substeps of kLoopSubsteps) {
    const theirs = {
      label: `${scene.name}, loop, ${substeps} substeps`,
      scene: scene.name,
      method: { stepper: 'loop', step_s: kStep, substeps },
      n_vertices: n * n,
      begin: (times) => loopTurns(n, { ...loop, masses }, substeps, kFrames, times),
    };
    const once = await rowOf(theirs, settings);
    if (!hasFinished(once)) {
      rows.push(once);
      continue;
    }
    const taken = Object.entries(candidates)
      .map(([stepper, ones]) => [stepper, cheapest(ones, once, hasReference)])
      .filter(([, best]) => best !== null);
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
    ratios.best.push(Math.max(...Object.keys(candidates).map(times)));
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
 * The worst of three numbers of the loop's substeps counts, of those with which it does not fly
 * apart. Where no reference is known, stretch alone is compared: errors in those rows are distances
 * from another run.
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
      const finished = found.filter(hasFinished);
      if (finished.length === 0) {
        const line = `shown loop_${name}_${n}: the loop flies apart with any of its substeps`;
        goals.push({ name: `loop_${name}_${n}`, ok: true, line });
        tell(line);
        continue;
      }
      goals.push(
        goal(`loop_${name}_${n}_times_faster`, best, 'at-least', promised(name, n), finished),
      );
      tell(goals.at(-1).line);
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
