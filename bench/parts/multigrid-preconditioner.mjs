// A step of implicit by conjugate gradients with each preconditioner: its iterations and milliseconds.
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { tell } from './bench-parts.mjs';
import { goal, markdown, median, short } from './bench-rows.mjs';
import { nativeTurns } from './command.mjs';
import { crumpledDress } from './crumpled-dress.mjs';
import { garmentScene } from './refinement-runs.mjs';
import { squareSheet } from './square-sheet.mjs';

const kStep = 1 / 60; // [s]
const kTolerances = [1e-3, 1e-6];
const kPreconditioners = ['incomplete_factor', 'multigrid', 'automatic'];

const kLevel = [
  [0, 1.5, 0],
  [1, 0, 0],
  [0, 0, 1],
];
const kEdge = [{ part: 'upper_edge' }];
const kCorners = [{ part: 'upper_left' }, { part: 'lower_left' }];
const kBall = { colliders: [{ sphere: { centre_m: [0, 0.6, 0], radius_m: 0.25 } }] };

/** A sheet of n x n vertices, let go from the horizontal. */
const sheet = (n, pins, more = {}) => ({
  cloth: squareSheet(n, ...kLevel),
  fabric: { name: 'fine cotton' },
  pins,
  ...more,
});

const kMembrane = { model: { stretch: 'membrane', bending: 'fitted' } };

const strip = {
  cloth: {
    sheet: {
      width_m: 0.25,
      height_m: 1,
      columns: 64,
      rows: 256,
      origin_m: kLevel[0],
      warp_direction: kLevel[1],
      weft_direction: kLevel[2],
    },
  },
  fabric: { name: 'fine cotton' },
  pins: kEdge,
};

const onBall = (n) => ({
  cloth: squareSheet(n, [-0.5, 0.87, -0.5], [0, 0, 1], [1, 0, 0]),
  fabric: { name: 'linen' },
  world: kBall,
});

/** A garment in a walk; its rows have a method of their own, and its substeps. */
export function walking(garment, level) {
  const { method, ...scene } = garmentScene(garment, 'walk');
  return { ...scene, refinement: { level }, substeps: method.substeps };
}

const dress = (file) => ({
  cloth: { mesh: { obj: file, warp_direction: [0, -1, 0] } },
  fabric: { name: 'fine cotton' },
  pins: [{ part: 'seam' }],
});

/** [scene, frames, what its rows are called]; the first frame is not timed. */
const scenesOf = (folder) => [
  ['sheet 33x33 by an edge', sheet(33, kEdge), 12],
  ['sheet 65x65 by an edge', sheet(65, kEdge), 12],
  ['sheet 129x129 by an edge', sheet(129, kEdge), 8],
  ['sheet 257x257 by an edge', sheet(257, kEdge), 3],
  ['sheet 257x257 by two corners', sheet(257, kCorners), 3],
  ['sheet 129x129 on a ball', onBall(129), 22],
  ['skirt in a walk', walking('skirt', 2), 8],
  ['crumpled dress of six pieces', dress(folder), 3],
  ['silk 65x65 by two corners', sheet(65, kCorners, { fabric: { name: 'silk' } }), 8],
  ['canvas 65x65 by two corners', sheet(65, kCorners, { fabric: { name: 'canvas' } }), 8],
  ['membrane 65x65, fitted bending', sheet(65, kCorners, kMembrane), 8],
  ['trousers in a walk', walking('trousers', 2), 4],
  ['strip 65x257 by an edge', strip, 6],
];

/** The scene with each preconditioner in turn, a frame each. */
async function compared(scene, { substeps = 1, ...about }, tolerance, frames, repeat) {
  const runs = kPreconditioners.map(() => []);
  for (let round = 0; round < repeat; ++round) {
    const begun = [];
    for (const preconditioner of kPreconditioners) {
      tell(`${scene}, ${tolerance}, round ${round + 1} of ${repeat}: ${preconditioner}`);
      const method = { stepper: 'implicit', step_s: kStep, substeps, tolerance, preconditioner };
      const named = { name: scene, duration_s: frames * kStep, ...about, method };
      begun.push(await nativeTurns(named, frames, []));
    }
    for (let done = 1; done < frames; ++done) for (const run of begun) await run.advance(1);
    for (const [i, run] of begun.entries()) runs[i].push(await run.finish());
  }
  return kPreconditioners.map((preconditioner, i) => {
    const [first] = runs[i];
    const ms = runs[i].map((run) => median(run.processor_ms) / substeps);
    return {
      scene,
      preconditioner,
      tolerance,
      n_vertices: first.n_vertices,
      iterations_per_step: first.iterations_per_frame / substeps,
      ms_per_step: median(ms),
      spread_ms: Math.max(...ms) - Math.min(...ms),
      residual: first.residual,
      status: first.status,
      commit: first.core,
    };
  });
}

/** Goals of the rows that are there. */
function goalsOf(found, timeOverFactor) {
  const kSheets = [33, 257].map((n) => `sheet ${n}x${n} by an edge`);
  const [coarsest, finest] = kSheets.map((scene) => found(scene, 'multigrid', 1e-6));
  const skirt = found('skirt in a walk', 'multigrid', 1e-6);
  const growth = coarsest && finest && finest.iterations_per_step / coarsest.iterations_per_step;
  const timed = { sheet_257: kSheets[1], dress: 'crumpled dress of six pieces' };
  return [
    growth && goal('multigrid.iterations_257_over_33', growth, 'at-most', 1.5, [coarsest, finest]),
    skirt && goal('multigrid.iterations_skirt', skirt.iterations_per_step, 'at-most', 20, [skirt]),
    ...Object.entries(timed).flatMap(([key, scene]) =>
      kTolerances.map((tolerance) => {
        const row = found(scene, 'multigrid', tolerance);
        const name = `multigrid.${key}_time_over_factor_${tolerance}`;
        return row && goal(name, timeOverFactor(row), 'at-most', 0.5, [row]);
      }),
    ),
  ];
}

export const clothOption = {
  name: 'cloth',
  type: 'string',
  usage: '--cloth TEXT      preconditioner: only cloth whose name contains it',
};

export async function preconditioner({ repeat, options }) {
  const { cloth = '' } = options;
  const folder = mkdtempSync(join(tmpdir(), 'pleat-dress-'));
  const rows = [];
  try {
    const file = join(folder, 'dress.obj');
    writeFileSync(file, crumpledDress(190, 25, 6));
    for (const [name, about, frames] of scenesOf(file).filter(([name]) => name.includes(cloth)))
      for (const tolerance of kTolerances)
        rows.push(...(await compared(name, about, tolerance, frames, repeat)));
  } finally {
    rmSync(folder, { recursive: true });
  }
  const found = (scene, preconditioner, tolerance) =>
    rows.find(
      (row) =>
        row.scene === scene && row.preconditioner === preconditioner && row.tolerance === tolerance,
    );
  const timeOverFactor = (row) =>
    row.ms_per_step / found(row.scene, 'incomplete_factor', row.tolerance).ms_per_step;
  const lines = rows.map((row) => [
    row.scene,
    row.n_vertices,
    row.tolerance,
    row.preconditioner,
    short(row.iterations_per_step),
    short(row.ms_per_step),
    short(row.spread_ms),
    short(timeOverFactor(row)),
    row.status,
  ]);
  const head = [
    'cloth',
    'vertices',
    'tolerance',
    'preconditioner',
    'iterations/step',
    'ms/step',
    'spread',
    'of the factor',
    'status',
  ];
  const goals = goalsOf(found, timeOverFactor).filter(Boolean);
  const text = `processor time of a step without the first frame; median of ${repeat} runs\n\n${markdown(head, lines)}`;
  return { rows, goals, text };
}
