// The fine skirt in a fast walk: position-based steps against implicit ones.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

import { commit, described, tell } from './bench-parts.mjs';
import { goal, measure, median } from './bench-rows.mjs';
import { nativeRun, reference, root } from './command.mjs';
import { contestant } from './contestants.mjs';
import { garmentScene } from './refinement-runs.mjs';
import { bothBuilds } from './refinement-wasm.mjs';

const kFrames = 120; // two seconds
const kTurnFrames = 6;
const kStep = 1 / 60; // [s]
/** When it is told how far methods are from a run of implicit steps [s]. */
const kTimes = [0.25];
const kMostMsPerPicture = 33; // a picture is shown for 1/30 s
const kPercent = 100;

const kImplicit = { stepper: 'implicit', substeps: 2 };
/** The page's own, of a skirt that walks as it is computed: 0.5 % RMS stretch in a fast walk. */
const kLive = JSON.parse(readFileSync(join(root, 'assets', 'methods', 'live_skirt.json'), 'utf8'));
const kMethods = { multigrid: kLive, implicit: kImplicit };

/** The scene on its fine mesh with just this method. */
function fineSkirt(method) {
  const scene = garmentScene('skirt', 'fast_walk');
  return { ...scene, refinement: { level: 2 }, method: { step_s: kStep, ...method } };
}

export async function skirt({ repeat, scale }) {
  const { n_vertices } = nativeRun(fineSkirt(kLive), 2);
  const contestants = Object.entries(kMethods).map(([label, method]) =>
    contestant('native', label, fineSkirt(method), n_vertices, kFrames),
  );
  const rows = await measure(contestants, {
    repeat,
    frames: kFrames,
    times: kTimes,
    against: reference(fineSkirt(kImplicit), 'run', kTimes),
    commit,
    tell,
    turnFrames: kTurnFrames,
  });
  const [ours, implicit] = rows;
  const { wasm } = await bothBuilds({ ...fineSkirt(kLive), duration_s: kFrames * kStep }, repeat);
  const wasmMs = median(wasm.map(({ ms_per_frame }) => ms_per_frame)); // of a picture
  const goals = [
    goal('skirt_of_implicit', ours.ms_per_frame / implicit.ms_per_frame, 'at-most', 1 / 3, rows),
    goal('skirt_rms_stretch_percent', kPercent * ours.rms_stretch, 'at-most', 0.5, rows),
    goal('skirt_largest_stretch_percent', kPercent * ours.largest_stretch, 'at-most', 15, rows),
    goal('skirt_wasm_ms_per_picture', wasmMs, 'at-most', kMostMsPerPicture * scale),
  ];
  return { rows, goals, text: described(rows) };
}
