// Shapes of least deformation energy in WebAssembly: their cost, with the keys of `pleat bench deform`.
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';

import { fabricsText } from './assets.mjs';
import { answer, wasmModule } from './contestants.mjs';

const kDone = 3; // last answer of Deformation.settle

/** The text of the mesh that a scene names; empty without one. */
function meshText(file, scene) {
  const name = scene.cloth.mesh?.obj;
  return name ? readFileSync(join(dirname(file), name), 'utf8') : '';
}

/** omega = v'/(v'_R + v'_S + v'_B) of a fabric. */
function fabricWeights(name) {
  const { fabrics } = JSON.parse(fabricsText());
  const { seed_table: table } = fabrics.find((fabric) => fabric.name_en === name);
  const sum = table.vn_recovery + table.vn_stretch + table.vn_bend;
  return {
    recovery: table.vn_recovery / sum,
    stretch: table.vn_stretch / sum,
    bending: table.vn_bend / sum,
  };
}

/** The pane comes to its least energy from where it is. */
function settle(shape, pane) {
  answer(shape.beginSettling(pane, false));
  while (shape.settle(pane) !== kDone);
}

/** Vertices that are held, and their places at rest and at the scene's targets, as one list each. */
function heldOf({ pins, rest_m, handles }) {
  const rest = (v) => rest_m.slice(3 * v, 3 * v + 3);
  const held = new Map(pins.map((v) => [v, rest(v)]));
  for (const { vertices, places_m } of handles)
    for (const [k, v] of vertices.entries()) held.set(v, places_m.slice(3 * k, 3 * k + 3));
  const vertices = [...held.keys()].sort((a, b) => a - b);
  return { vertices, begin: vertices.flatMap(rest), end: vertices.flatMap((v) => held.get(v)) };
}

/**
 * Cost of the way from rest to the scene's targets, then of a hand that takes the handles there in
 * equal moves. A second pane has the least energy of each move.
 */
export async function deformWasm(file, moves) {
  const text = readFileSync(file, 'utf8');
  const scene = JSON.parse(text);
  const module = await wasmModule();
  const shape = new module.Deformation(fabricsText());
  const opened = answer(shape.open(text, meshText(file, scene)));
  const weights = fabricWeights(scene.fabric);
  const { vertices, begin, end } = heldOf(opened);
  const show = (panes) =>
    answer(shape.show(JSON.stringify({ form: 'consistent', weights: Array(panes).fill(weights) })));
  const clock = performance.now();
  show(1);
  answer(shape.hold(vertices, end));
  answer(shape.restart(0));
  settle(shape, 0);
  const total_ms = performance.now() - clock;
  const { energy, converged, steps } = answer(shape.report(0));
  show(2);
  answer(shape.hold(vertices, begin));
  for (const pane of [0, 1]) {
    answer(shape.restart(pane));
    settle(shape, pane);
  }
  const drag = { update_ms: [], excess: [] };
  for (let move = 1; move <= moves; ++move) {
    shape.moveHeld(begin.map((from, q) => from + ((end[q] - from) * move) / moves));
    const start = performance.now();
    answer(shape.follow(0));
    drag.update_ms.push(performance.now() - start);
    answer(shape.follow(1));
    settle(shape, 1);
    drag.excess.push(answer(shape.report(0)).energy / answer(shape.report(1)).energy - 1);
  }
  shape.delete();
  const status = converged ? 'ok' : 'not_converged';
  const cost = { total_ms, steps: steps.length, energy, status };
  return { scene: scene.name, n_vertices: opened.n_vertices, target: 'wasm', cost, drag };
}
