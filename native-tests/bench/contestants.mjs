// Runs of one scene by different programs, all told alike: a run has milliseconds and stretch per
// frame of 1/60 s, positions at the wanted times, and how it ended. Every run builds its state
// anew, and its first frame is not on the clock.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import v8 from 'node:v8';

import { BadInput } from './bench-options.mjs';
import { hasFinished } from './bench-rows.mjs';
import { makeSheet, frame as yardstickFrame, stretch as yardstickStretch } from './yardstick.mjs';

const kFrame = 1 / 60; // [s]
const kMaxOutput = 2 ** 30; // [bytes]; positions are printed as text

export const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..');
export const command = join(root, 'build', 'release', 'cli', 'pleat');
const wasmFolder = join(root, 'build', 'wasm', 'wasm');
const cacheFolder = join(root, 'build', 'references');

function withSceneFile(scene, work) {
  const folder = mkdtempSync(join(tmpdir(), 'pleat-bench-'));
  try {
    const file = join(folder, 'scene.json');
    writeFileSync(file, JSON.stringify(scene));
    return work(file);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** The command's answer in JSON; status 1 is an answer too: a run that ended early. */
function ask(words) {
  const options = { encoding: 'utf8', maxBuffer: kMaxOutput, stdio: ['ignore', 'pipe', 'pipe'] };
  try {
    return JSON.parse(execFileSync(command, words, options));
  } catch (error) {
    if (error.status === 1 && error.stdout) return JSON.parse(error.stdout);
    throw new Error(error.stderr || error.message);
  }
}

/**
 * Positions that are taken for right: `kind` is "rigid_chain", "closed_form", or "run" for the
 * scene's own method; runs are kept in build/references.
 */
export function reference(scene, kind, times) {
  return withSceneFile(scene, (file) =>
    ask([
      'bench',
      'reference',
      file,
      '--kind',
      kind,
      '--times',
      times.join(),
      '--cache',
      cacheFolder,
    ]),
  );
}

export function nativeRun(scene, frames, times, options = []) {
  const run = withSceneFile(scene, (file) =>
    ask(
      [
        'bench',
        'run',
        file,
        '--frames',
        frames,
        ...(times.length ? ['--times', times.join()] : []),
        ...options,
      ].map(String),
    ),
  );
  return {
    target: 'native',
    firstMs: run.first_ms,
    ms: run.ms,
    rms: run.rms_stretch,
    largest: run.largest_stretch,
    samples: run.samples.map((sample) => sample.positions_m),
    masses: run.masses_kg,
    residual: run.residual,
    parts: run.parts_ms,
    status: run.status,
    message: run.message,
    method: run.method,
    memory: run.process_peak_memory_bytes,
    core: run.core,
  };
}

/** The rows of `pleat sweep`. A setting that was refused or ended early is a row too. */
export function nativeSweep(scene, { levels, repeat, reference: kind, duration }) {
  return withSceneFile(scene, (file) => {
    const plan = ['--levels', levels, '--repeat', repeat, '--reference', kind];
    const words = [
      'sweep',
      file,
      '--json',
      '--cache',
      cacheFolder,
      '--duration',
      duration,
      ...plan,
    ];
    const options = {
      encoding: 'utf8',
      maxBuffer: kMaxOutput,
      stdio: ['ignore', 'pipe', 'inherit'],
    };
    let rows;
    try {
      rows = execFileSync(command, words.map(String), options);
    } catch (error) {
      if (error.status === 2) throw new BadInput(''); // the command has said why
      if (error.status !== 1) throw error;
      rows = error.stdout;
    }
    return rows
      .trim()
      .split('\n')
      .map((line) => JSON.parse(line));
  });
}

const compiled = {};

/**
 * A module of its own for each run, so that memory and state are the run's alone: "pleat" has
 * Scene and Simulation, "sweep" has Experiment.
 */
export async function wasmModule(name = 'pleat') {
  if (!compiled[name]) {
    // V8 would begin with unoptimised code and swap it at a moment of its own.
    v8.setFlagsFromString('--no-liftoff');
    compiled[name] = await WebAssembly.compile(readFileSync(join(wasmFolder, `${name}.wasm`)));
  }
  const { default: create } = await import(join(wasmFolder, `${name}.mjs`));
  return create({
    instantiateWasm: (imports, receive) => {
      WebAssembly.instantiate(compiled[name], imports).then((instance) => receive(instance));
      return {};
    },
  });
}

function answer(text) {
  const envelope = JSON.parse(text);
  if (!envelope.ok) throw new Error(`${envelope.where}: ${envelope.what}`);
  return envelope;
}

export function fabricsText() {
  return readFileSync(join(root, 'assets', 'fabrics', 'fabrics.json'), 'utf8');
}

export async function wasmRun(scene, frames, times) {
  const module = await wasmModule();
  const simulation = new module.Simulation(fabricsText());
  answer(simulation.load(JSON.stringify(scene)));
  const stepsPerFrame = Math.round(kFrame / scene.method.step_s);
  const run = {
    target: 'wasm',
    ms: [],
    rms: [],
    largest: [],
    samples: [],
    residual: 0,
    status: 'ok',
    message: '',
  };
  for (let f = 0; f < frames; ++f) {
    const begin = performance.now();
    simulation.step(stepsPerFrame);
    const ms = performance.now() - begin;
    const state = answer(simulation.status());
    if (state.status !== 'ok') [run.status, run.message] = [state.status, state.message];
    if (!hasFinished(run)) break;
    if (f > 0) run.ms.push(ms);
    const numbers = answer(simulation.numbers());
    run.rms.push(numbers.rms_stretch);
    run.largest.push(numbers.largest_stretch);
    run.residual = Math.max(run.residual, numbers.residual);
    if (run.samples.length < times.length && (f + 1.5) * kFrame > times[run.samples.length])
      run.samples.push(Array.from(simulation.exactPositions()));
  }
  run.masses = Array.from(simulation.masses());
  run.memory = simulation.exactPositions().buffer.byteLength;
  simulation.delete();
  return run;
}

/**
 * The plain JavaScript loop on the same sheet, with the masses of ours where its own are not
 * pinned.
 */
export function yardstickRun(n, substeps, order, frames, times, masses) {
  const sheet = makeSheet(n, order);
  for (const [i, mass] of (masses ?? []).entries()) if (sheet.w[i] > 0) sheet.w[i] = 1 / mass;
  const run = {
    target: 'javascript',
    ms: [],
    rms: [],
    largest: [],
    samples: [],
    status: 'ok',
    message: '',
  };
  for (let f = 0; f < frames; ++f) {
    const begin = performance.now();
    yardstickFrame(sheet, substeps);
    const ms = performance.now() - begin;
    if (f > 0) run.ms.push(ms);
    const now = yardstickStretch(sheet);
    run.rms.push(now.rms);
    run.largest.push(now.max);
    if (run.samples.length < times.length && (f + 1.5) * kFrame > times[run.samples.length])
      run.samples.push(Array.from(sheet.x));
  }
  run.constraints = sheet.rest.length;
  return run;
}
