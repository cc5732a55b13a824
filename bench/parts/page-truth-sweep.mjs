// The sweep that the page offers first, in its WebAssembly, and the setting that somebody would take
// from it: the cheapest that is near enough.
import { readdirSync, readFileSync } from 'node:fs';

import { asset, fabricsText, shippedScene } from './assets.mjs';
import { atMost, table } from './bench-rows.mjs';
import { answer, wasmModule } from './contestants.mjs';

const kScene = 'swinging_sheet';
const kLevels = [0, 1];
const kReferenceLevel = 3;
const kDuration = 0.4; // [s], until meshes move differently
const kStep = 1 / 60; // [s]
const kRepeat = 5;
const kSliceMs = 200; // a report's work
const kNearEnough = 5e-3; // [m]
const kMostStretch = 0.02;

/** The methods that the page's sweep measures at every level. */
function methods(module) {
  const scene = new module.Scene('');
  const { steppers } = JSON.parse(scene.steppers());
  scene.delete();
  const isQuick = (row) => (row.finest_sweep_level ?? kReferenceLevel) >= kReferenceLevel;
  return steppers
    .filter((row) => row.models.includes('springs') && isQuick(row))
    .flatMap((row) =>
      row.sweep.map((counts) => ({ stepper: row.name, step_s: kStep, ...counts })),
    );
}

function planOf(module) {
  const settings = kLevels.flatMap((level) =>
    methods(module).map((method) => ({ '/refinement/level': level, '/method': method })),
  );
  return {
    scene: shippedScene(kScene),
    settings,
    duration_s: kDuration,
    repeats: kRepeat,
    reference: 'converged',
    reference_level: kReferenceLevel,
  };
}

/** Rows of a plan, compared with the references that are shipped. */
function measured(module, plan) {
  const folder = asset('references', 'sweep', kScene);
  const experiment = new module.Experiment(fabricsText());
  const { references } = answer(experiment.start(JSON.stringify(plan)));
  const shipped = readdirSync(folder);
  for (const id of references) {
    const file = `${id}.reference`;
    if (!shipped.includes(file)) throw new Error(`${kScene}: no reference ${id} is shipped`);
    answer(experiment.keepReference(readFileSync(`${folder}/${file}`)));
  }
  let told = answer(experiment.advance(kSliceMs));
  while (!told.done) told = answer(experiment.advance(kSliceMs));
  experiment.delete();
  return told;
}

export async function sweep() {
  const module = await wasmModule();
  const { rows, front } = measured(module, planOf(module));
  const isNear = ({ position_error_m: error }) => error !== null && error <= kNearEnough;
  const near = front.map((index) => rows[index]).filter(isNear);
  const [winner] = near.sort((a, b) => a.ms_per_frame - b.ms_per_frame);
  const columns = {
    method: ({ method }) => method.stepper,
    level: 'level',
    substeps: 'n_substeps',
    'ms a frame': 'ms_per_frame',
    'error mm': ({ position_error_m: error }) => (error === null ? null : 1000 * error),
    'largest stretch %': ({ largest_stretch }) => 100 * largest_stretch,
    taken: (row) => (row === winner ? 'within 5 mm' : ''),
  };
  const stretch = winner?.largest_stretch ?? Number.POSITIVE_INFINITY;
  return {
    rows,
    goals: [atMost('sweep_winner_stretch', stretch, kMostStretch, rows)],
    text: `swinging sheet over ${kDuration} s, the page's first sweep\n\n${table(rows, columns)}`,
  };
}
