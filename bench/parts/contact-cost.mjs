// Cost of self-contact in a frame, by the number of faces, of cloth that swings and of cloth in
// folds; and what a scene pays that has it switched off.
import {
  atMost,
  exponent,
  largest,
  mean,
  measure,
  median,
  sideBySide,
  spread,
  table,
} from './bench-rows.mjs';
import { commit, reference } from './command.mjs';
import { kStretches, kTimes } from './contact-columns.mjs';
import { curtain, swinging, withContact } from './contact-scenes.mjs';
import { contestant } from './contestants.mjs';
import { by, cotton, kEdge, kLimp, kStep, lying } from './sheets.mjs';

const kMethod = { stepper: 'multigrid', substeps: 5 };
const kFrames = 36;
const kCells = [32, 72, 160]; // cells along a side: 2 000, 10 000 and 50 000 faces
const kTurnFrames = { 32: 12, 72: 3, 160: 1 };
const kScenes = { swinging, curtain: (n) => curtain(n, kFrames * kStep) };

const kMostUsPerFace = 1; // us a face in a frame, at 10 000 faces
const kMostGrowth = 1.15;
const kNoise = 1.05; // interleaved medians differ by less

/** A scene of n x n cells, with self-contact and without in turn. */
async function costRow(name, n, repeat) {
  const [guarded, free] = [true, false].map((on) => withContact(kScenes[name](n), kMethod, on));
  const contestants = [
    contestant('native', `${n}x${n}, self-contact`, guarded, kFrames),
    contestant('native', `${n}x${n}, without`, free, kFrames),
  ];
  const settings = { repeat, frames: kFrames, turnFrames: kTurnFrames[n] };
  const [with_, without] = await sideBySide(contestants, settings);
  const costs = with_.map(({ ms }, round) => mean(ms) - mean(without[round].ms));
  const n_faces = 2 * n * n;
  return {
    scene: guarded.name,
    case: name,
    method: with_[0].method,
    n_faces,
    ms_per_frame: median(with_.map(({ ms }) => mean(ms))),
    ms_per_frame_without: median(without.map(({ ms }) => mean(ms))),
    cost_ms: median(costs),
    spread_ms: spread(costs),
    us_per_face: (1e3 * median(costs)) / n_faces,
    largest_stretch: largest(with_[0].largest_stretch),
    largest_stretch_without: largest(without[0].largest_stretch),
    process_peak_memory_bytes: with_[0].process_peak_memory_bytes,
    status: with_[0].status,
    reference: { id: 'without', description: 'the same frames without self-contact' },
    commit,
  };
}

const kColumns = {
  scene: 'scene',
  faces: 'n_faces',
  ...kTimes,
  'cost ms': 'cost_ms',
  spread: 'spread_ms',
  ...kStretches,
  'memory MB': (row) => row.process_peak_memory_bytes / 1e6,
  status: 'status',
};

/** Goals of the dearest scene. */
export function costGoals(rows, scale) {
  const middle = rows.filter(({ n_faces }) => n_faces === 2 * kCells[1] ** 2);
  const names = [...new Set(rows.map((row) => row.case))];
  const growths = names.map((name) =>
    exponent(rows.filter((row) => row.case === name).map((row) => [row.n_faces, row.cost_ms])),
  );
  const us = largest(middle.map(({ us_per_face }) => us_per_face));
  return [
    atMost('us_per_face_10000', us, kMostUsPerFace * scale, middle),
    atMost('growth_exponent', largest(growths), kMostGrowth, rows),
  ];
}

export async function cost({ repeat, scale }) {
  const rows = [];
  for (const name of Object.keys(kScenes))
    for (const n of kCells) rows.push(await costRow(name, n, repeat));
  const { stepper, substeps } = kMethod;
  const text = `${stepper}, ${substeps} substeps, mean of ${kFrames - 1} frames\n\n${table(rows, kColumns)}`;
  return { rows, goals: costGoals(rows, scale), text };
}

const kMethods = {
  xpbd: { stepper: 'xpbd', substeps: 30, iterations: 1 },
  implicit: { stepper: 'implicit', substeps: 1, solver: 'cg', tolerance: 1e-2 },
};

/** Self-contact that is switched off against a scene that does not speak of it, which runs twice. */
export async function absent({ repeat }) {
  const times = [0.5, 1];
  const rows = [];
  const goals = [];
  for (const [name, method] of Object.entries(kMethods)) {
    const plain = by(cotton('swinging sheet', 65, lying, kEdge, kLimp), method);
    const contestants = [
      contestant('native', `${name}, not spoken of`, plain),
      contestant('native', `${name}, not spoken of, again`, plain),
      contestant('native', `${name}, switched off`, { ...plain, world: { self_contact: false } }),
    ];
    const against = reference(plain, 'rigid_chain', times);
    const found = await measure(contestants, { repeat, times, against, turnFrames: 8 });
    rows.push(...found);
    const ratio = found[2].times_as_long_as_first;
    goals.push(atMost(`switched_off_cost_${name}`, ratio, kNoise, found));
  }
  const columns = {
    contestant: 'label',
    'ms/frame': 'ms_per_frame',
    'time over the first': 'times_as_long_as_first',
    'errors mm': (row) => 1e3 * row.position_error_m,
    status: 'status',
  };
  return { rows, goals, text: table(rows, columns) };
}
