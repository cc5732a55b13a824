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

/** What `work` makes of a file that holds the scene and is gone afterwards. */
export function withSceneFile(scene, work) {
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
 * Scene and Simulation, "sweep" has Experiment, "refinement" has GarmentRun.
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

/** What a module's call answered; throws where it refused. */
export function answer(text) {
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

/** Least deformation energy of a scene's file, as `pleat bench deform` tells it. */
export function deformNative(file, options = []) {
  return ask(['bench', 'deform', file, ...options]);
}

/** The text of the mesh that a scene names; empty without one. */
function meshText(file, scene) {
  const name = scene.cloth.mesh?.obj;
  return name ? readFileSync(join(dirname(file), name), 'utf8') : '';
}

/** omega = v'/(v'_R + v'_S + v'_B) of a fabric. */
function fabricWeights(name) {
  const { seed_table: table } = JSON.parse(fabricsText()).fabrics.find(
    (fabric) => fabric.name_en === name,
  );
  const sum = table.vn_recovery + table.vn_stretch + table.vn_bend;
  return {
    recovery: table.vn_recovery / sum,
    stretch: table.vn_stretch / sum,
    bending: table.vn_bend / sum,
  };
}

const kConverged = 2; // what Deformation.step returns at the end, or more

function stepToTheEnd(shape, pane) {
  let steps = 0;
  for (let progress = 0; progress < kConverged; ++steps) progress = shape.step(pane, true);
  return steps;
}

/**
 * The same in WebAssembly: from rest to the scene's targets, then a hand that takes the handles
 * there in equal moves. A second pane has the least energy of each move.
 */
export async function deformWasm(file, moves) {
  const kStepsOfMove = 4;
  const text = readFileSync(file, 'utf8');
  const scene = JSON.parse(text);
  const module = await wasmModule('deform');
  const shape = new module.Deformation(fabricsText());
  const opened = answer(shape.open(text, meshText(file, scene)));
  const weights = fabricWeights(scene.fabric);
  const held = new Map();
  for (const v of opened.pins) held.set(v, opened.rest_m.slice(3 * v, 3 * v + 3));
  for (const { vertices, places_m } of opened.handles)
    for (const [k, v] of vertices.entries()) held.set(v, places_m.slice(3 * k, 3 * k + 3));
  const vertices = [...held.keys()].sort((a, b) => a - b);
  const begin = vertices.flatMap((v) => opened.rest_m.slice(3 * v, 3 * v + 3));
  const end = vertices.flatMap((v) => held.get(v));
  const clock = performance.now();
  answer(shape.show(JSON.stringify({ form: 'consistent', weights: [weights] })));
  answer(shape.hold(vertices, end));
  answer(shape.restart(0));
  const steps = stepToTheEnd(shape, 0);
  const total_ms = performance.now() - clock;
  const { energy, converged } = answer(shape.report(0));
  answer(shape.show(JSON.stringify({ form: 'consistent', weights: [weights, weights] })));
  answer(shape.hold(vertices, begin));
  for (const pane of [0, 1]) {
    answer(shape.restart(pane));
    stepToTheEnd(shape, pane);
  }
  const drag = { update_ms: [], excess: [] };
  for (let move = 1; move <= moves; ++move) {
    shape.moveHeld(begin.map((from, q) => from + ((end[q] - from) * move) / moves));
    const start = performance.now();
    answer(shape.follow(0));
    for (let k = 0; k < kStepsOfMove; ++k) if (shape.step(0, k === 0) >= kConverged) break;
    drag.update_ms.push(performance.now() - start);
    answer(shape.follow(1));
    stepToTheEnd(shape, 1);
    drag.excess.push(answer(shape.report(0)).energy / answer(shape.report(1)).energy - 1);
  }
  shape.delete();
  const cost = {
    total_ms,
    steps,
    energy,
    build_ms: Number.NaN,
    assembly_ms: Number.NaN,
    factor_ms: Number.NaN,
    solve_ms: Number.NaN,
    linearisations: '',
    status: converged ? 'ok' : 'not_converged',
  };
  return { scene: scene.name, n_vertices: opened.n_vertices, target: 'wasm', cost, drag };
}
