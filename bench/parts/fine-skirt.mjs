// The fine skirt in a fast walk: position-based steps against implicit ones.
import { asset, garmentScene, readJson } from './assets.mjs';
import { atMost, described, measure, median } from './bench-rows.mjs';
import { reference } from './command.mjs';
import { contestant } from './contestants.mjs';
import { bothBuilds } from './refinement-wasm.mjs';
import { by, kStep } from './sheets.mjs';

const kFrames = 120; // two seconds
const kTurnFrames = 6;
/** When it is told how far methods are from a run of implicit steps [s]. */
const kTimes = [0.25];
const kMostMsPerPicture = 33; // a picture is shown for 1/30 s
const kPercent = 100;

const kImplicit = { stepper: 'implicit', substeps: 2 };
/** The page's own, of a skirt that walks as it is computed: 0.5 % RMS stretch in a fast walk. */
const kLive = readJson(asset('methods', 'live_skirt.json'));
const kMethods = { multigrid: kLive, implicit: kImplicit };

/** The scene on its fine mesh with just this method. */
const fineSkirt = (method) =>
  by({ ...garmentScene('skirt', 'fast_walk'), refinement: { level: 2 } }, method);

export async function skirt({ repeat, scale }) {
  const contestants = Object.entries(kMethods).map(([label, method]) =>
    contestant('native', label, fineSkirt(method), kFrames),
  );
  const rows = await measure(contestants, {
    repeat,
    frames: kFrames,
    times: kTimes,
    against: reference(fineSkirt(kImplicit), 'run', kTimes),
    turnFrames: kTurnFrames,
  });
  const [ours, implicit] = rows;
  const { wasm } = await bothBuilds({ ...fineSkirt(kLive), duration_s: kFrames * kStep }, repeat);
  const wasmMs = median(wasm.map(({ ms_per_frame }) => ms_per_frame)); // time of a picture
  const goals = [
    atMost('skirt_of_implicit', ours.ms_per_frame / implicit.ms_per_frame, 1 / 3, rows),
    atMost('skirt_rms_stretch_percent', kPercent * ours.rms_stretch, 0.5, rows),
    atMost('skirt_largest_stretch_percent', kPercent * ours.largest_stretch, 15, rows),
    atMost('skirt_wasm_ms_per_picture', wasmMs, kMostMsPerPicture * scale),
  ];
  return { rows, goals, text: described(rows) };
}
