// ./pleat bench sweep (--help tells the options)
// One sweep by the native command and by WebAssembly: stepper x level, milliseconds, stretch and
// position error.
import { asset, fabricsText, readJson } from './parts/assets.mjs';
import { BadInput, oneOf, reasonOf, wholeNumber } from './parts/bench-options.mjs';
import { runParts } from './parts/bench-parts.mjs';
import { table } from './parts/bench-rows.mjs';
import { askRows, cacheFolder } from './parts/command.mjs';
import { answer, wasmModule } from './parts/contestants.mjs';
import { methodWords } from './parts/honesty-order.mjs';

const kSliceMs = 200; // time between reports of progress
const kDuration = 1; // [s]

function readScene(file) {
  try {
    return readJson(file);
  } catch (error) {
    throw new BadInput(`${file}: expected a scene file in JSON, got ${reasonOf(error)}`);
  }
}

/** The scene of a file that the core can read. */
async function checkedScene(file, reference) {
  const scene = readScene(file);
  const module = await wasmModule();
  const reader = new module.Scene(fabricsText());
  const { ok, where, what } = JSON.parse(reader.parse(JSON.stringify(scene)));
  reader.delete();
  if (!ok) throw new BadInput(`${file}: ${where}: ${what}`);
  // The chain does not bend.
  if (reference === 'rigid_chain') scene.model = { ...scene.model, bending: 'none' };
  return scene;
}

async function wasmSweep(scene, repeats, reference, nativeRows) {
  const settings = nativeRows.map((row) => row.setting);
  const plan = { scene, settings, duration_s: kDuration, repeats, reference };
  const module = await wasmModule();
  const experiment = new module.Experiment(fabricsText());
  let told = answer(experiment.start(JSON.stringify(plan)));
  while (!told.done) {
    told = answer(experiment.advance(kSliceMs));
    process.stderr.write(process.stderr.isTTY ? `\r\x1b[K${told.message}` : '');
  }
  experiment.delete();
  return told.rows;
}

function solverWords({ stepper, solver, ...method }, substeps) {
  const isSolved = stepper === 'implicit' || stepper === 'projective';
  return methodWords({ ...method, stepper: isSolved ? `${stepper} ${solver}` : stepper }, substeps);
}

async function sweep({ repeat, options }) {
  const { levels = '0,1,2', words } = options;
  const kind = oneOf('--reference', options.reference ?? 'rigid_chain', [
    'rigid_chain',
    'converged',
  ]);
  for (const level of levels.split(',')) wholeNumber('--levels', level, 0);
  const scene = await checkedScene(words[0] ?? asset('scenes', 'swinging_sheet.json'), kind);
  const native = askRows(
    ...['sweep', scene, '--json', '--cache', cacheFolder, '--duration', kDuration],
    ...['--levels', levels, '--repeat', repeat, '--reference', kind],
  );
  const wasm = await wasmSweep(scene, repeat, kind, native);
  // Both lists hold the same settings in the same order.
  const pairs = native.map((row, i) => ({ ...row, wasm_ms: wasm[i].ms_per_frame }));
  const columns = {
    method: (row) => solverWords(row.method, row.n_substeps),
    level: 'level',
    vertices: 'n_vertices',
    'native ms/frame': 'ms_per_frame',
    'wasm ms/frame': 'wasm_ms',
    'position error mm': (row) => 1e3 * row.position_error_m,
    '%': 'position_error_percent',
    'rms stretch %': (row) => 100 * row.rms_stretch,
    'largest %': (row) => 100 * row.largest_stretch,
    status: 'status',
  };
  return {
    rows: [...native, ...wasm],
    goals: [],
    text: `${scene.name}, ${kDuration} s, frames of 1/60 s; errors against ${native[0].reference.description}\n\n${table(pairs, columns)}`,
  };
}

const purpose =
  '[SCENE.json]   one sweep natively and as WebAssembly (default: the swinging sheet)';
const more = {
  '--levels 0,1,2': 'refinement levels (default 0,1,2)',
  '--repeat N': 'timed runs of each setting (default 5)',
  '--reference KIND': 'rigid_chain (default; bending is then left out) or converged',
};
await runParts('sweep', purpose, { sweep }, { more, isScaled: false, most: 1 });
