// Steppers against a plain JavaScript loop: the cheapest setting that stretches no more.
import { tell } from './bench-options.mjs';
import { atLeast, described, hasFinished, measure } from './bench-rows.mjs';
import { nativeRun, reference } from './command.mjs';
import { contestant } from './contestants.mjs';
import { kScenes } from './loop-scenes.mjs';
import { loopContestant } from './plain-loop.mjs';
import { by } from './sheets.mjs';

const kTimes = [0.5, 1]; // [s]

const kLoopSubsteps = [30, 100, 300];
const kTurnFrames = 4;
/** Carries as much as is useful: with more, the noise of projections grows. */
const kCarried = { carried_acceleration: 0.3 };
const kSmooth = { smoother: 'gauss_seidel' };
const kAfter = { smoother_before: 'none' };
const kAlone = { levels: 0 };

/** Each number of substeps with each of these settings. */
const product = (substeps, settings) =>
  substeps.flatMap((count) => settings.map((more) => ({ substeps: count, ...more })));

const kCandidates = {
  xpbd: product(
    [
      5, 7, 8, 9, 10, 11, 12, 14, 17, 20, 23, 26, 30, 40, 50, 60, 70, 85, 100, 140, 200, 220, 250,
      300,
    ],
    [{ constraints: 'rigid' }],
  ),
  multigrid: [
    ...product(
      [4, 5, 6, 7, 8, 9, 10, 12, 15, 20, 25, 30, 45, 60, 90],
      [
        {},
        kAfter,
        { ...kAfter, ...kAlone },
        kCarried,
        { ...kCarried, ...kAlone },
        { ...kCarried, ...kAfter, ...kAlone },
        { smoother_before: 'gauss_seidel', ...kSmooth },
        { ...kAfter, ...kSmooth, ...kAlone },
      ],
    ),
    // Sweeps of xpbd whose diagonals give way, for cloth without pins.
    ...product(
      [17, 40, 50, 75, 120, 140, 170, 200],
      [{}, kCarried].map((more) => ({ ...more, ...kAfter, ...kAlone })),
    ),
  ],
  // Springs of the fabric, for cloth that folds where no rigid link lets it.
  projective: [
    { substeps: 1, iterations: 3 },
    { substeps: 1 },
    { substeps: 2, iterations: 3 },
    { substeps: 4, iterations: 3 },
  ],
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
async function candidatesOf(scene, methods, settings) {
  const candidates = [];
  for (const method of methods) {
    const ours = contestant('wasm', labelOf(method), by(scene, method));
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
  const plain = by(scene, { stepper: 'xpbd', constraints: 'rigid' });
  const { masses_kg: masses } = nativeRun(plain, 2);
  const kind = hasReference ? 'rigid_chain' : 'run';
  const settings = { times: kTimes, against: reference(plain, kind, kTimes) };
  const rows = [];
  const ratios = { best: [], xpbd: [] };
  const candidates = {};
  for (const [stepper, methods] of Object.entries(kCandidates)) {
    const named = methods.map((method) => ({ stepper, ...method }));
    candidates[stepper] = await candidatesOf(scene, named, settings);
  }
  for (const substeps of kLoopSubsteps) {
    const theirs = loopContestant(scene.name, n, substeps, { ...loop, masses });
    const once = await rowOf(theirs, settings);
    if (!hasFinished(once)) {
      rows.push(once);
      continue;
    }
    const taken = Object.entries(candidates)
      .map(([stepper, ones]) => [stepper, cheapest(ones, once, hasReference)])
      .filter(([, best]) => best !== null);
    const contestants = [theirs, ...taken.map(([, best]) => best.ours)];
    const turns = { ...settings, repeat, turnFrames: kTurnFrames };
    const measured = await measure(contestants, turns);
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

const shown = (name, text) => ({ name, ok: true, line: `shown ${name}${text}` });

/**
 * The worst of three numbers of the loop's substeps counts, of those with which it does not fly
 * apart. Where no reference is known, stretch alone is compared: errors in those rows are distances
 * from another run.
 */
export async function loop({ repeat, options }) {
  const rows = [];
  const goals = [];
  const sizes = options.vertices ? [Number(options.vertices)] : [33, 65, 129];
  for (const scene of Object.keys(kScenes).filter((one) => one.includes(options.scene ?? '')))
    for (const n of sizes) {
      const name = `loop_${scene}_${n}`;
      const { rows: found, best, xpbd } = await contest(scene, n, repeat);
      rows.push(...found);
      const finished = found.filter(hasFinished);
      goals.push(
        ...(finished.length === 0
          ? [shown(name, ': the loop flies apart with any of its substeps')]
          : [
              atLeast(`${name}_times_faster`, best, promised(scene, n), finished),
              shown(`${name}_xpbd`, `_times_faster ${xpbd.toPrecision(3)}`),
            ]),
      );
      tell(goals.at(-1).line);
    }
  return { rows, goals, text: described(rows) };
}

export const loopOptions = {
  '--scene TEXT': 'loop: scenes with this in their name',
  '--vertices N': 'loop: sheets of N x N alone',
};
