// Programs that compute one scene, in turn: each builds its state anew, runs a first frame that is
// not timed, then as many frames of 1/60 s as its turn has, and at its end tells of the run with
// the keys of `pleat bench run`.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import v8 from 'node:v8';

import { fabricsText, root } from './assets.mjs';
import { tell } from './bench-options.mjs';
import { hasFinished, measure } from './bench-rows.mjs';
import { nativeTurns, reference } from './command.mjs';
import { by, kStep } from './sheets.mjs';

const wasmFolder = join(root, 'build', 'wasm', 'wasm');

let compiled = null;

/** The built module, anew for each run, so that memory and state are the run's alone. */
export async function wasmModule() {
  if (!compiled) {
    // V8 would start with unoptimised code and swap it at a moment of its own.
    v8.setFlagsFromString('--no-liftoff');
    const files = ['pleat.wasm', 'pleat-rest.wasm'].map((name) =>
      readFileSync(join(wasmFolder, name)),
    );
    compiled = await Promise.all(files.map((bytes) => WebAssembly.compile(bytes)));
  }
  const { default: create } = await import(join(wasmFolder, 'pleat.mjs'));
  return create({ parts: compiled });
}

/** Answer of a module's call; throws where it refused. */
export function answer(text) {
  const envelope = JSON.parse(text);
  if (!envelope.ok) throw new Error(`${envelope.where}: ${envelope.what}`);
  return envelope;
}

/**
 * A program's run frame by frame.
 *
 * program: {target, step, look: () => {rms_stretch, largest_stretch, ...}, positions: () => array,
 *           end: () => more keys of the run}; look is outside of the clock
 */
export function turnsOf(program, frames, times) {
  const run = {
    target: program.target,
    n_vertices: program.positions().length / 3,
    ms: [],
    processor_ms: [],
    rms_stretch: [],
    largest_stretch: [],
    samples: [],
    residual: 0,
    status: 'ok',
    message: '',
  };
  let frame = 0;
  const advance = async (count) => {
    for (const end = Math.min(frame + count, frames); frame < end && hasFinished(run); ++frame) {
      const processor = process.cpuUsage();
      const begin = performance.now();
      program.step();
      const ms = performance.now() - begin;
      const { user, system } = process.cpuUsage(processor); // [us]
      const seen = program.look();
      if (seen.status !== 'ok') [run.status, run.message] = [seen.status, seen.message];
      if (!hasFinished(run)) return;
      if (frame > 0) {
        run.ms.push(ms);
        run.processor_ms.push((user + system) / 1e3);
      }
      run.rms_stretch.push(seen.rms_stretch);
      run.largest_stretch.push(seen.largest_stretch);
      run.residual = Math.max(run.residual, seen.residual ?? 0);
      if (run.samples.length < times.length && (frame + 1.5) * kStep > times[run.samples.length])
        run.samples.push({ positions_m: Array.from(program.positions()) });
    }
  };
  const finish = async () => ({ ...run, ...program.end() });
  return advance(1).then(() => ({ advance, finish }));
}

async function wasmTurns(scene, frames, times) {
  const module = await wasmModule();
  const simulation = new module.Simulation(fabricsText());
  answer(simulation.load(JSON.stringify(scene)));
  const stepsPerFrame = Math.round(kStep / scene.method.step_s);
  const program = {
    target: 'wasm',
    step: () => simulation.step(stepsPerFrame),
    look: () => ({ ...answer(simulation.numbers()), ...answer(simulation.status()) }),
    positions: () => simulation.exactPositions(),
    end: () => {
      const masses_kg = Array.from(simulation.masses());
      const process_peak_memory_bytes = simulation.exactPositions().buffer.byteLength;
      simulation.delete();
      return { masses_kg, process_peak_memory_bytes };
    },
  };
  return turnsOf(program, frames, times);
}

/** The stepper alone, natively. */
const bareTurns = (scene, frames, times) => nativeTurns(scene, frames, times, ['--bare']);

const kTurns = { wasm: wasmTurns, native: nativeTurns, bare: bareTurns };

/** A scene's contestant: in WebAssembly, natively, or its stepper alone. */
export function contestant(target, label, scene, frames = 60) {
  return {
    label: `${scene.name}, ${label}`,
    scene: scene.name,
    method: scene.method,
    begin: (times) => kTurns[target](scene, frames, times),
  };
}

/**
 * Rows of native runs in turn, against `newton` with `exactSteps` of a frame on the scene `exact`,
 * half way and at the end.
 *
 * scenes: {label: scene}
 */
export function againstNewton(scenes, exact, { repeat, frames, exactSteps = 16 }) {
  const times = [(frames * kStep) / 2, frames * kStep];
  tell(`reference of ${exact.name}`);
  const method = { stepper: 'newton', step_s: kStep / exactSteps };
  const against = reference(by(exact, method), 'run', times);
  const contestants = Object.entries(scenes).map(([label, scene]) =>
    contestant('native', label, scene, frames),
  );
  return measure(contestants, { repeat, times, against, frames, turnFrames: 5 });
}
