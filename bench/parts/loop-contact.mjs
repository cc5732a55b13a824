// Cost of a ball to a position-based step, and to a plain JavaScript loop.
import { atMost, described, measure } from './bench-rows.mjs';
import { nativeRun, reference } from './command.mjs';
import { contestant } from './contestants.mjs';
import { kBall, kScenes } from './loop-scenes.mjs';
import { loopContestant } from './plain-loop.mjs';
import { by } from './sheets.mjs';

const kTimes = [0.2, 0.4, 0.6, 0.8, 1]; // [s]
const kVertices = 65; // vertices along a side
const kSubsteps = 30;
const kTurnFrames = 8;
/** Rounding of a place in single precision about a local origin [m]. */
const kRounding = 1e-6;

/** The least distance of a vertex to the ball's surface in all samples [m]; below 0 inside. */
export function nearest(samples, centre, radius) {
  let least = Number.POSITIVE_INFINITY;
  for (const { positions_m: x } of samples)
    for (let i = 0; i < x.length; i += 3) {
      const distance = Math.hypot(x[i] - centre[0], x[i + 1] - centre[1], x[i + 2] - centre[2]);
      // Math.min and comparisons would pass over NaN.
      if (!(distance - radius >= least)) least = distance - radius;
    }
  return least;
}

/** The contestant, which keeps how deep it was in the ball at the times of its samples. */
function watched(one) {
  const seen = { ...one, depth_m: 0 };
  seen.begin = async (times) => {
    const { advance, finish } = await one.begin(times);
    const kept = async () => {
      const run = await finish();
      seen.depth_m = Math.max(seen.depth_m, -nearest(run.samples, kBall.centre, kBall.radius));
      return run;
    };
    return { advance, finish: kept };
  };
  return seen;
}

export async function contact({ repeat }) {
  const n = kVertices;
  const method = { stepper: 'xpbd', constraints: 'rigid', substeps: kSubsteps };
  const onBall = by(kScenes.ball.ours(n), method);
  const { world, ...falling } = onBall;
  const label = `xpbd, ${kSubsteps} substeps`;
  const { masses_kg: masses } = nativeRun(onBall, 2);
  const contestants = [
    watched(contestant('wasm', label, onBall)),
    contestant('wasm', `${label}, no ball`, falling),
    watched(loopContestant(onBall.name, n, kSubsteps, { ...kScenes.ball.loop, masses })),
  ];
  const against = reference(onBall, 'run', kTimes);
  const settings = { repeat, times: kTimes, against, turnFrames: kTurnFrames };
  const rows = await measure(contestants, settings);
  const [ball, free, loop] = rows;
  const [ours, , theirs] = contestants;
  const mostDepth = 1e3 * Math.max(theirs.depth_m, kRounding);
  const goals = [
    atMost('contact_over_free_fall', ball.ms_per_frame / free.ms_per_frame, 1.4, rows),
    atMost('contact_of_loop', ball.ms_per_frame / loop.ms_per_frame, 0.35, rows),
    atMost('contact_rms_stretch_of_loop', ball.rms_stretch / loop.rms_stretch, 1, rows),
    atMost('contact_depth_mm', 1e3 * ours.depth_m, mostDepth, rows),
  ];
  return { rows, goals, text: described(rows) };
}
