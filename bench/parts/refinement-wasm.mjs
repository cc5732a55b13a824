// A garment on one mesh in WebAssembly, called as the page calls it, in turn with the native
// command.
import { fabricsText } from './assets.mjs';
import { tell } from './bench-options.mjs';
import { inTurn, median } from './bench-rows.mjs';
import { ask, nativeRun } from './command.mjs';
import { answer, wasmModule } from './contestants.mjs';
import { kStep } from './sheets.mjs';

const kFrame = 1 / 30; // [s]
const kNoSamples = 1_000_000; // frames from one to the next
export const kEarly = 0.5; // [s], after which both builds are compared
export const kTight = 1e-12; // tolerance of the solver, with which rounding does not grow

async function opened(scene) {
  const module = await wasmModule();
  const run = new module.GarmentRun(fabricsText());
  const { n_vertices, step_s } = answer(run.load(JSON.stringify(scene), {}));
  return { run, n_vertices, steps: (seconds) => run.step(Math.round(seconds / step_s)) };
}

/** Wall time of a run's contact so far [ms]. */
const contactMs = (run) => answer(run.costs()).parts_ms.contact ?? 0;

/** Frames of the second half are timed, as the native command does. */
async function wasmTimes(scene) {
  const { run, n_vertices, steps } = await opened(scene);
  const nFrames = Math.round(scene.duration_s / kFrame);
  const found = { target: 'wasm', n_vertices, status: 'ok', message: '' };
  const frameMs = [];
  let contactBefore = 0;
  for (let frame = 1; frame <= nFrames; ++frame) {
    const isTimed = frame > nFrames / 2;
    if (!isTimed) contactBefore = contactMs(run);
    const begin = performance.now();
    const code = steps(kFrame);
    const ms = performance.now() - begin;
    const { status, message } = answer(run.status());
    if (status !== 'ok') Object.assign(found, { status, message });
    if (code !== 0) break;
    if (isTimed) frameMs.push(ms);
  }
  const contact_ms = (contactMs(run) - contactBefore) / frameMs.length;
  run.delete();
  return { ...found, ms_per_frame: median(frameMs), contact_ms, n_timed_frames: frameMs.length };
}

const nativeTimes = (scene) => ask('bench', 'together', scene, '--every', kNoSamples).runs[0];

/** The largest of any coordinate after kEarly [m]; NaN where a run did not come that far. */
async function largestDifference(scene) {
  const { run, steps } = await opened(scene);
  const code = steps(kEarly);
  const positions = Array.from(run.positions());
  run.delete();
  const [right] = nativeRun(scene, Math.round(kEarly / kStep), [kEarly]).samples;
  if (code !== 0 || !right) return Number.NaN;
  return Math.max(...positions.map((value, q) => Math.abs(value - right.positions_m[q])));
}

/** How far both builds come apart: as the scene is, and with its equations solved to kTight. */
export async function differences(scene) {
  tell(`${scene.name}: wasm against native`);
  const tight = { ...scene, method: { ...scene.method, tolerance: kTight } };
  return { own_m: await largestDifference(scene), tight_m: await largestDifference(tight) };
}

/** Runs of one scene in both builds, round by round in turn. */
export async function bothBuilds(scene, repeat) {
  const [wasm, native] = await inTurn(repeat, [
    { label: `${scene.name}, wasm`, run: () => wasmTimes(scene) },
    { label: `${scene.name}, native`, run: () => nativeTimes(scene) },
  ]);
  return { wasm, native };
}
