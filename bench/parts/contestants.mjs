// Programs that compute one scene, in turn: each builds its state anew, runs a first frame that is
// not timed, then as many frames of 1/60 s as its turn has, and at its end tells of the run with
// the keys of `pleat bench run`.
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import v8 from 'node:v8';

import { hasFinished } from './bench-rows.mjs';
import { nativeTurns, root } from './command.mjs';
import { makeSheet, frame as yardstickFrame, stretch as yardstickStretch } from './yardstick.mjs';

const kFrame = 1 / 60; // [s]
const wasmFolder = join(root, 'build', 'wasm', 'wasm');

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

/**
 * A program's run frame by frame.
 *
 * program: {target, step, look: () => {rms_stretch, largest_stretch, ...}, positions: () => array,
 *           end: () => more keys of the run}; look is outside of the clock
 */
export function turnsOf(program, frames, times) {
  const run = {
    target: program.target,
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
      if (run.samples.length < times.length && (frame + 1.5) * kFrame > times[run.samples.length])
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
  const stepsPerFrame = Math.round(kFrame / scene.method.step_s);
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
export function contestant(target, label, scene, vertices, frames) {
  const turns = kTurns[target];
  return {
    label: `${scene.name}, ${label}`,
    scene: scene.name,
    method: scene.method,
    n_vertices: vertices,
    begin: (times) => turns(scene, frames, times),
  };
}

/**
 * The plain JavaScript loop on the same sheet, with the masses of ours where its own are not
 * pinned.
 */
export function yardstickTurns(n, substeps, order, frames, times, masses = []) {
  const sheet = makeSheet(n, order);
  for (const [i, mass] of masses.entries()) if (sheet.w[i] > 0) sheet.w[i] = 1 / mass;
  const program = {
    target: 'javascript',
    step: () => yardstickFrame(sheet, substeps),
    look: () => {
      const { rms, max } = yardstickStretch(sheet);
      return { status: 'ok', rms_stretch: rms, largest_stretch: max };
    },
    positions: () => sheet.x,
    end: () => ({ masses_kg: masses, n_constraints: sheet.rest.length }),
  };
  return turnsOf(program, frames, times);
}

/**
 * Runs the loop in both orders until V8 has compiled it for good, and at once, not beside it: its
 * code is then the same in all turns.
 */
export function warmUpYardstick() {
  const kWarmMs = 300; // of processor time, in each order
  v8.setFlagsFromString('--no-concurrent-recompilation');
  for (const order of ['rows', 'coloured']) {
    const sheet = makeSheet(33, order);
    const begin = process.cpuUsage().user;
    while (process.cpuUsage().user - begin < 1e3 * kWarmMs) yardstickFrame(sheet, 30);
  }
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

/** Frames between keys, OBJ files of one mesh, in WebAssembly: the keys of `pleat bench inbetween`. */
export async function completionWasm(files, frames) {
  const module = await wasmModule('modal');
  const keys = files.map((file) => readFileSync(file, 'utf8'));
  const found = answer(module.completionCost(keys, frames));
  return { ...found, status: found.unconverged > 0 ? 'not_converged' : 'ok', target: 'wasm' };
}
