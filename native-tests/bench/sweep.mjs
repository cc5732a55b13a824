// ./pleat bench sweep [SCENE.json] [--levels 0,1,2] [--repeat N] [--json FILE]
//   [--reference rigid_chain|finest]
// The same sweep by the native command and by WebAssembly: stepper x level, milliseconds, stretch
// and position error.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { parseArgs } from 'node:util';

import { short } from './bench-rows.mjs';
import { fabricsText, nativeSweep, root, wasmModule } from './contestants.mjs';

const kSliceMs = 200; // between reports of progress

const { values: options, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    levels: { type: 'string', default: '0,1,2' },
    repeat: { type: 'string', default: '5' },
    reference: { type: 'string', default: 'rigid_chain' },
    json: { type: 'string' },
  },
});
const file = positionals[0] ?? join(root, 'assets', 'scenes', 'swinging_sheet.json');
const kDuration = 1; // [s]

/** The scene without what the chain has not. */
function comparableScene() {
  const scene = JSON.parse(readFileSync(file, 'utf8'));
  if (options.reference === 'rigid_chain') scene.model = { ...scene.model, bending: 'none' };
  return scene;
}

async function wasmSweep(scene, nativeRows) {
  const methods = [
    ...new Map(nativeRows.map((row) => [JSON.stringify(row.method), row.method])).values(),
  ];
  const plan = {
    scene,
    levels: options.levels.split(',').map(Number),
    methods,
    duration_s: kDuration,
    repeats: Number(options.repeat),
    reference: options.reference,
  };
  const module = await wasmModule();
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

const scene = comparableScene();
const native = nativeSweep(scene, { ...options, duration: kDuration });
const wasm = await wasmSweep(scene, native);
const same = (row) =>
  wasm.find(
    (other) =>
      other.level === row.level && JSON.stringify(other.method) === JSON.stringify(row.method),
  );

console.log(
  `${scene.name}, ${kDuration} s, frames of 1/60 s; errors against ${native[0].reference.description}\n`,
);
console.log(
  '| method | level | vertices | native ms/frame | wasm ms/frame | position error mm | % | rms stretch % | largest % |',
);
console.log('|---|---|---|---|---|---|---|---|---|');
for (const row of native) {
  const cells = [
    describe(row.method, row.n_substeps),
    row.level,
    row.n_vertices,
    short(row.ms_per_frame),
    short(same(row)?.ms_per_frame),
    short(row.position_error_m === null ? null : 1e3 * row.position_error_m),
    short(row.position_error_percent),
    short(100 * row.rms_stretch),
    short(100 * row.largest_stretch),
  ];
  console.log(`| ${cells.join(' | ')} |`);
}
if (options.json)
  writeFileSync(
    options.json,
    [...native, ...wasm].map((row) => `${JSON.stringify(row)}\n`).join(''),
  );
