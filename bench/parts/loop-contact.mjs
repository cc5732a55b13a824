// What a ball costs a position-based step, and a plain JavaScript loop.
import { commit, described, tell } from './bench-parts.mjs';
import { goal, measure } from './bench-rows.mjs';
import { nativeRun, reference } from './command.mjs';
import { contestant } from './contestants.mjs';
import { kBall, kScenes } from './loop-scenes.mjs';
import { loopTurns } from './plain-loop.mjs';

const kFrames = 60; // one second
const kTimes = [0.2, 0.4, 0.6, 0.8, 1]; // [s]
const kVertices = 65; // along a side
const kSubsteps = 30;
const kTurnFrames = 8;
/** What single precision about a local origin rounds a place to [m]. */
const kRounding = 1e-6;

/** How deep the deepest vertex is in the ball [m]. */
function depthIn(positions, { centre, radius }) {
  let deepest = 0;
  for (let i = 0; i < positions.length; i += 3) {
    const square = centre.reduce((sum, c, k) => sum + (positions[i + k] - c) ** 2, 0);
    deepest = Math.max(deepest, radius - Math.sqrt(square));
  }
  return deepest;
}

/** The same contestant, which keeps how deep it was in the ball at the times of its samples. */
function watched(one) {
  const seen = { ...one, depth_m: 0 };
  seen.begin = async (times) => {
    const { advance, finish } = await one.begin(times);
    return {
      advance,
      finish: async () => {
        const run = await finish();
        for (const { positions_m } of run.samples)
          seen.depth_m = Math.max(seen.depth_m, depthIn(positions_m, kBall));
        return run;
      },
    };
  };
  return seen;
}

export async function contact({ repeat }) {
  const n = kVertices;
  const onBall = kScenes.ball.ours(n);
  const { world, ...falling } = onBall;
  const method = { stepper: 'xpbd', constraints: 'rigid', step_s: 1 / 60, substeps: kSubsteps };
  const label = `xpbd, ${kSubsteps} substeps`;
  const { masses_kg: masses } = nativeRun({ ...onBall, method }, 2);
  const contestants = [
    watched(contestant('wasm', label, { ...onBall, method }, n * n, kFrames)),
    contestant('wasm', `${label}, no ball`, { ...falling, method }, n * n, kFrames),
    watched({
      label: `${onBall.name}, loop, ${kSubsteps} substeps`,
      scene: onBall.name,
      method: { stepper: 'loop', step_s: 1 / 60, substeps: kSubsteps },
      n_vertices: n * n,
      begin: (times) => loopTurns(n, { ...kScenes.ball.loop, masses }, kSubsteps, kFrames, times),
    }),
  ];
  const rows = await measure(contestants, {
    repeat,
    times: kTimes,
    against: reference({ ...onBall, method }, 'run', kTimes),
    commit,
    tell,
    turnFrames: kTurnFrames,
  });
  const [ball, free, loop] = rows;
  const [ours, , theirs] = contestants;
  const goals = [
    goal('contact_over_free_fall', ball.ms_per_frame / free.ms_per_frame, 'at-most', 1.4, rows),
    goal('contact_of_loop', ball.ms_per_frame / loop.ms_per_frame, 'at-most', 0.35, rows),
    goal('contact_rms_stretch_of_loop', ball.rms_stretch / loop.rms_stretch, 'at-most', 1, rows),
    goal(
      'contact_depth_mm',
      1e3 * ours.depth_m,
      'at-most',
      1e3 * Math.max(theirs.depth_m, kRounding),
      rows,
    ),
  ];
  return { rows, goals, text: described(rows) };
}
