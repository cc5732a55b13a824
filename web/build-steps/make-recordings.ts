// Makes what the view of refinement shows without computing it, by the native command: see
// assets/recordings/README.md. Run by `npm run recordings`.

import { execFile } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { deflateSync } from 'node:zlib';
import type {
  ExampleStudyHandle,
  GarmentRunHandle,
  RefinementModule,
} from '../src/refinement/bindings/refinement-module.ts';
import {
  FINE_LEVEL,
  FRAME_S,
  KEPT_OF,
  PATTERNS,
  SETTLED_S,
  USUAL_DEMANDS_MM,
} from '../src/refinement/state/garment-frames.ts';
import {
  encodeFrames,
  type Parents,
  type RecordingHead,
} from '../src/refinement/worker/recording.ts';
import { builtCore } from './built-core.ts';

/** Share of the density of air that is added, so that a second run on the fine mesh has another chance. */
const AIR_CHANGE = 1e-6;

/** Duration of the frames of the test motion [s]. */
const TEST_S = 5;

/** The end of the example [s]. */
const EXAMPLE_S = 8;

/** Rounding of places [m] and of curvature [1/m]. */
const QUANTUM = { place: 1e-4, curvature: 1e-3 };

const root = fileURLToPath(new URL('../..', import.meta.url));
const command = join(root, 'build/release/cli/pleat');
const temporary = mkdtempSync(join(tmpdir(), 'pleat-recordings-'));
const readText = (path: string) => readFileSync(join(root, path), 'utf8');
const fabrics = readText('assets/fabrics/fabrics.json');
const module = await builtCore<RefinementModule>();

/** The scene, on its own mesh or so refined, with the files that it names written out. */
function sceneOf(name: string, refinement: object | null, durationS: number) {
  const scene = JSON.parse(readText(`assets/scenes/garments/${name}.json`));
  const named = (file: string) => JSON.parse(readText(join('assets/scenes/garments', file)));
  return {
    ...scene,
    figure: { ...scene.figure, motion: named(scene.figure.motion) },
    start: named(scene.start),
    refinement: refinement ?? scene.refinement,
    duration_s: durationS,
    record: { every_s: FRAME_S, format: 'binary' },
  };
}

type Garment = keyof typeof USUAL_DEMANDS_MM;
type Scene = ReturnType<typeof sceneOf>;

interface Run {
  frames: Float64Array[];
  /** Time of a frame on one core [ms]. */
  msPerFrame: number;
}

/** Runs a scene natively and reads its frames, the first one as it begins. */
async function run(scene: Scene, pane: string): Promise<Run> {
  const name = `${scene.name}-${pane}`;
  const file = join(temporary, `${name}.json`);
  const out = join(temporary, name);
  writeFileSync(file, JSON.stringify(scene));
  const timed = `TIMEFORMAT=%U; time "$@" 2> "$0.log"`;
  const { stderr } = await promisify(execFile)('bash', [
    '-c',
    timed,
    out,
    command,
    'run',
    file,
    '--out',
    out,
  ]);
  const bytes = readFileSync(join(out, 'frames.bin'));
  const begin = bytes.indexOf('\n') + 1;
  const { n_vertices: n } = JSON.parse(bytes.toString('utf8', 0, begin));
  const size = 8 * (1 + 3 * n);
  const frames: Float64Array[] = [];
  for (let at = begin; at + size <= bytes.length; at += size) {
    const own = bytes.buffer.slice(bytes.byteOffset + at + 8, bytes.byteOffset + at + size);
    frames.push(new Float64Array(own));
  }
  const seconds = Number(stderr.trim());
  console.log(`${name}: ${frames.length} frames, ${seconds} s`);
  return { frames, msPerFrame: (1000 * seconds) / (frames.length - 1) };
}

interface Place {
  folder: string;
  file: string;
}

function write({ folder, file }: Place, content: string | Uint8Array): void {
  const path = join(root, 'assets/recordings', folder);
  mkdirSync(path, { recursive: true });
  writeFileSync(join(path, file), content);
  console.log(`${folder}/${file}: ${(content.length / 1e6).toFixed(2)} MB`);
}

type HeadPart = Pick<
  RecordingHead,
  'name' | 'quantum' | 'n_components' | 'first_s' | 'every_s' | 'ms_per_frame'
>;

function writeRecording(
  place: Place,
  part: HeadPart,
  parents: Parents,
  frames: readonly ArrayLike<number>[],
): void {
  const head: RecordingHead = {
    format: 'pleat recording 1',
    n_vertices: parents.length / 4,
    n_frames: frames.length,
    ...part,
  };
  const body = deflateSync(encodeFrames(head, parents, frames), { level: 9 });
  write(place, Buffer.concat([Buffer.from(`${JSON.stringify(head)}\n`), body]));
}

function answered<Answer>(text: string): Answer {
  const answer = JSON.parse(text);
  if (!answer.ok) throw new Error(`${answer.where}: ${answer.what}`);
  return answer;
}

function parentsOf(scene: object): Parents {
  const made: GarmentRunHandle = new module.GarmentRun(fabrics);
  answered(made.load(JSON.stringify(scene), {}));
  const parents = made.parents().slice();
  made.delete();
  return parents;
}

/** Features, frames for limits, and the usual plan, which is made of what is written, not of more. */
async function makeExample(garment: Garment): Promise<object> {
  const folder = `${garment}_walk`;
  const scene = sceneOf(folder, { level: FINE_LEVEL }, EXAMPLE_S);
  const { frames, msPerFrame } = await run(scene, 'example');
  const parents = parentsOf(scene);
  const first = Math.round(SETTLED_S / FRAME_S) + 1;
  const seen = frames.slice(first);
  const kept = seen.filter((_, index) => index % KEPT_OF === 0);
  const study: ExampleStudyHandle = new module.ExampleStudy(fabrics);
  answered(study.open(JSON.stringify(scene), {}));
  for (const frame of seen) answered(study.addFrame(Float32Array.from(frame)));
  const features = study.features().slice();
  const part = {
    name: folder,
    first_s: first * FRAME_S,
    every_s: KEPT_OF * FRAME_S,
    ms_per_frame: msPerFrame,
  };
  writeRecording(
    { folder, file: 'example.recording' },
    { ...part, quantum: QUANTUM.place, n_components: 3 },
    parents,
    kept,
  );
  writeRecording(
    { folder, file: 'features.recording' },
    { ...part, quantum: QUANTUM.curvature, n_components: 2 },
    parents,
    [features],
  );
  answered(study.open(JSON.stringify(scene), {}));
  const rounded = (values: ArrayLike<number>, quantum: number) =>
    Float32Array.from(values, (value) => Math.round(value / quantum) * quantum);
  for (const frame of kept) answered(study.addFrame(rounded(frame, QUANTUM.place)));
  answered(study.sort(folder, rounded(features, QUANTUM.curvature), PATTERNS));
  const planned = answered<{ plan: object }>(
    study.plan(JSON.stringify({ largest_loss_m: USUAL_DEMANDS_MM[garment] / 1000 })),
  );
  study.delete();
  write({ folder, file: 'plan.json' }, JSON.stringify(planned.plan));
  return planned.plan;
}

async function makePane(folder: string, pane: string, scene: Scene): Promise<void> {
  const { frames, msPerFrame } = await run(scene, pane);
  writeRecording(
    { folder, file: `${pane}.recording` },
    {
      name: scene.name,
      first_s: 0,
      every_s: FRAME_S,
      ms_per_frame: msPerFrame,
      quantum: QUANTUM.place,
      n_components: 3,
    },
    parentsOf(scene),
    frames,
  );
}

/** How differently folded two runs on the fine mesh are, and how far their surfaces are at the same times. */
async function makeFloor(folder: string, scene: Scene): Promise<void> {
  const { air } = scene.world;
  const density = air.density_kg_per_m3 * (1 + AIR_CHANGE);
  const twin = { ...scene, world: { ...scene.world, air: { ...air, density_kg_per_m3: density } } };
  const files = [scene, twin].map((one, k) => {
    const file = join(temporary, `${scene.name}-floor-${k}.json`);
    writeFileSync(file, JSON.stringify(one));
    return file;
  });
  const [own, other] = files as [string, string];
  const words = ['bench', 'together', own, '--with', other, '--from', SETTLED_S, '--every', 1];
  const { stdout } = await promisify(execFile)(command, words.map(String));
  const { runs } = JSON.parse(stdout);
  const of = (run: { folds_m: number[][] }) => Float64Array.from(run.folds_m.flat());
  const made: GarmentRunHandle = new module.GarmentRun(fabrics);
  const { distance_m: folds } = answered<{ distance_m: number }>(
    made.compareFolds(of(runs[0]), of(runs[1])),
  );
  made.delete();
  const floor = { folds_m: folds, surface_m: runs[1].errors.surface_m };
  write({ folder, file: 'floor.json' }, `${JSON.stringify(floor)}\n`);
}

async function makeGarment(garment: Garment): Promise<void> {
  const plan = await makeExample(garment);
  const test = `${garment}_fast_walk`;
  const fine = sceneOf(test, { level: FINE_LEVEL }, TEST_S);
  await makePane(test, 'coarse', sceneOf(test, { level: 0 }, TEST_S));
  await makePane(test, 'even', sceneOf(`${garment}_even_fast_walk`, null, TEST_S));
  await makePane(test, 'planned', sceneOf(test, { plan }, TEST_S));
  await makePane(test, 'fine', fine);
  await makeFloor(test, fine);
}

const all = Object.keys(USUAL_DEMANDS_MM) as Garment[];
const named = process.argv.slice(2);
const wanted = all.filter((garment) => named.length === 0 || named.includes(garment));
try {
  for (const garment of wanted) await makeGarment(garment);
} finally {
  rmSync(temporary, { recursive: true });
}
