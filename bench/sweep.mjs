// ./pleat bench sweep (--help tells the options)
// The same sweep by the native command and by WebAssembly: stepper x level, milliseconds, stretch
// and position error.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

import {
  BadInput,
  oneOf,
  readOptions,
  reasonOf,
  rowsFile,
  runBench,
  wholeNumber,
} from './parts/bench-options.mjs';
import { markdown, short } from './parts/bench-rows.mjs';
import { askRows, cacheFolder, root } from './parts/command.mjs';
import { fabricsText, wasmModule } from './parts/contestants.mjs';

const kSliceMs = 200; // between reports of progress
const kDuration = 1; // [s]
const kUsage = `./pleat bench sweep [SCENE.json]   one sweep natively and as WebAssembly
  SCENE.json        default: assets/scenes/swinging_sheet.json
  --levels 0,1,2    refinement levels (default 0,1,2)
  --repeat N        timed runs of each setting (default 5)
  --reference KIND  rigid_chain (default; bending is then left out) or converged
  --json FILE       write the rows as JSON lines
Exit status: 0 done, 2 bad input.`;

function readScene(file) {
  let text;
  try {
    text = readFileSync(file, 'utf8');
  } catch (error) {
    throw new BadInput(`${file}: expected a scene file, got ${reasonOf(error)}`);
  }
  try {
    return JSON.parse(text);
  } catch (error) {
    throw new BadInput(`${file}: expected JSON, got ${error.message}`);
  }
}

/** The scene of a file that the core can read. */
async function checkedScene(file, reference) {
  const scene = readScene(file);
  const module = await wasmModule();
  const reader = new module.Scene(fabricsText());
  const answer = JSON.parse(reader.parse(JSON.stringify(scene)));
  reader.delete();
  if (!answer.ok) throw new BadInput(`${file}: ${answer.where}: ${answer.what}`);
  // The chain does not bend.
  if (reference === 'rigid_chain') scene.model = { ...scene.model, bending: 'none' };
  return scene;
}

async function wasmSweep(scene, { repeat, reference }, nativeRows) {
  const plan = {
    scene,
    settings: nativeRows.map((row) => row.setting),
    duration_s: kDuration,
    repeats: repeat,
    reference,
  };
  const module = await wasmModule('sweep');
  const experiment = new module.Experiment(fabricsText());
  let answer = JSON.parse(experiment.start(JSON.stringify(plan)));
  while (answer.ok && !answer.done) {
    answer = JSON.parse(experiment.advance(kSliceMs));
    if (answer.ok) process.stderr.write(process.stderr.isTTY ? `\r\x1b[K${answer.message}` : '');
  }
  experiment.delete();
  if (!answer.ok) throw new Error(`${answer.where}: ${answer.what}`);
  return answer.rows;
}

function describe(method, substeps) {
  const solver =
    method.stepper === 'implicit' || method.stepper === 'projective' ? ` ${method.solver}` : '';
  return `${method.stepper}${solver}, ${substeps} substeps${method.iterations > 1 ? ` x ${method.iterations}` : ''}`;
}

/** Both lists hold the same settings in the same order. */
function table(native, wasm) {
  const head = [
    'method',
    'level',
    'vertices',
    'native ms/frame',
    'wasm ms/frame',
    'position error mm',
    '%',
    'rms stretch %',
    'largest %',
    'status',
  ];
  const lines = native.map((row, i) => [
    describe(row.method, row.n_substeps),
    row.level,
    row.n_vertices,
    short(row.ms_per_frame),
    short(wasm[i].ms_per_frame),
    short(1e3 * row.position_error_m),
    short(row.position_error_percent),
    short(100 * row.rms_stretch),
    short(100 * row.largest_stretch),
    row.status,
  ]);
  return markdown(head, lines);
}

await runBench('sweep', async (words) => {
  const options = readOptions(
    words,
    kUsage,
    {
      levels: { type: 'string', default: '0,1,2' },
      repeat: { type: 'string', default: '5' },
      reference: { type: 'string', default: 'rigid_chain' },
      json: { type: 'string' },
    },
    1,
  );
  if (options === null) return;
  const reference = oneOf('--reference', options.reference, ['rigid_chain', 'converged']);
  const repeat = wholeNumber('--repeat', options.repeat, 1);
  for (const level of options.levels.split(',')) wholeNumber('--levels', level, 0);
  const file = rowsFile(options.json);
  const [sceneFile = join(root, 'assets', 'scenes', 'swinging_sheet.json')] = options.words;
  const scene = await checkedScene(sceneFile, reference);
  const native = askRows(
    ...['sweep', scene, '--json', '--cache', cacheFolder, '--duration', kDuration],
    ...['--levels', options.levels, '--repeat', repeat, '--reference', reference],
  );
  file.write(native);
  const wasm = await wasmSweep(scene, { repeat, reference }, native);
  console.log(
    `${scene.name}, ${kDuration} s, frames of 1/60 s; errors against ${native[0].reference.description}\n`,
  );
  console.log(table(native, wasm));
  file.write([...native, ...wasm]);
});
