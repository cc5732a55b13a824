// A step of implicit by conjugate gradients with each preconditioner: its iterations and milliseconds.
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { garmentScene } from './assets.mjs';
import { atMost, median, sideBySide, spread, table } from './bench-rows.mjs';
import { inFolder, nativeTurns } from './command.mjs';
import { crumpledDress, dressScene } from './crumpled-dress.mjs';
import { by, kEdge, kStep, squareSheet } from './sheets.mjs';

const kTolerances = [1e-3, 1e-6];
const kPreconditioners = ['incomplete_factor', 'multigrid', 'automatic'];

const kLevel = [
  [0, 1.5, 0],
  [1, 0, 0],
  [0, 0, 1],
];
const kCorners = [{ part: 'upper_left' }, { part: 'lower_left' }];
const kBall = { colliders: [{ sphere: { centre_m: [0, 0.6, 0], radius_m: 0.25 } }] };
const kMembrane = { model: { stretch: 'membrane', bending: 'fitted' } };

/** A sheet of n x n vertices, let go from the horizontal. */
export const horizontal = (n, pins, more = {}) => ({
  cloth: squareSheet(n, ...kLevel),
  fabric: { name: 'fine cotton' },
  pins,
  ...more,
});

function strip() {
  const scene = horizontal(65, kEdge);
  Object.assign(scene.cloth.sheet, { width_m: 0.25, rows: 256 });
  return scene;
}

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

const by2Corners = (fabric) => horizontal(65, kCorners, { fabric: { name: fabric } });

/** {name in the rows: [scene, frames]}; the first frame is not timed. */
const scenesOf = (dress) => ({
  'sheet 33x33 by an edge': [horizontal(33, kEdge), 12],
  'sheet 65x65 by an edge': [horizontal(65, kEdge), 12],
  'sheet 129x129 by an edge': [horizontal(129, kEdge), 8],
  'sheet 257x257 by an edge': [horizontal(257, kEdge), 3],
  'sheet 257x257 by two corners': [horizontal(257, kCorners), 3],
  'sheet 129x129 on a ball': [onBall(129), 22],
  'skirt in a walk': [walking('skirt', 2), 8],
  'crumpled dress of six pieces': [dressScene(dress), 3],
  'silk 65x65 by two corners': [by2Corners('silk'), 8],
  'canvas 65x65 by two corners': [by2Corners('canvas'), 8],
  'membrane 65x65, fitted bending': [horizontal(65, kCorners, kMembrane), 8],
  'trousers in a walk': [walking('trousers', 2), 4],
  'strip 65x257 by an edge': [strip(), 6],
});

/** The scene with each preconditioner in turn, a frame each. */
async function compared(scene, { substeps = 1, ...about }, tolerance, frames, repeat) {
  const contestants = kPreconditioners.map((preconditioner) => {
    const method = { stepper: 'implicit', substeps, tolerance, preconditioner };
    const named = by({ name: scene, duration_s: frames * kStep, ...about }, method);
    const label = `${scene}, ${tolerance}: ${preconditioner}`;
    return { label, begin: () => nativeTurns(named, frames, []) };
  });
  const runs = await sideBySide(contestants, { repeat, frames, turnFrames: 1 });
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
      spread_ms: spread(ms),
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
  const goals = [
    growth && atMost('iterations_257_over_33', growth, 1.5, [coarsest, finest]),
    skirt && atMost('iterations_skirt', skirt.iterations_per_step, 20, [skirt]),
    ...Object.entries(timed).flatMap(([key, scene]) =>
      kTolerances.map((tolerance) => {
        const row = found(scene, 'multigrid', tolerance);
        const name = `${key}_time_over_factor_${tolerance}`;
        return row && atMost(name, timeOverFactor(row), 0.5, [row]);
      }),
    ),
  ];
  return goals.filter(Boolean);
}

export const clothOption = {
  '--cloth TEXT': 'preconditioner: only cloth whose name contains it',
};

const rowsOf = ({ repeat, options }) =>
  inFolder(async (folder) => {
    const file = join(folder, 'dress.obj');
    writeFileSync(file, crumpledDress(190, 25, 6));
    const rows = [];
    for (const [name, [scene, frames]] of Object.entries(scenesOf(file)))
      for (const tolerance of name.includes(options.cloth ?? '') ? kTolerances : [])
        rows.push(...(await compared(name, scene, tolerance, frames, repeat)));
    return rows;
  });

export async function preconditioner(wanted) {
  const rows = await rowsOf(wanted);
  const found = (scene, preconditioner, tolerance) =>
    rows.find(
      (row) =>
        row.scene === scene && row.preconditioner === preconditioner && row.tolerance === tolerance,
    );
  const timeOverFactor = (row) =>
    row.ms_per_step / found(row.scene, 'incomplete_factor', row.tolerance).ms_per_step;
  const columns = {
    cloth: 'scene',
    vertices: 'n_vertices',
    tolerance: 'tolerance',
    preconditioner: 'preconditioner',
    'iterations/step': 'iterations_per_step',
    'ms/step': 'ms_per_step',
    spread: 'spread_ms',
    'of the factor': timeOverFactor,
    status: 'status',
  };
  const goals = goalsOf(found, timeOverFactor);
  const text = `processor time of a step without the first frame; median of ${wanted.repeat} runs\n\n${table(rows, columns)}`;
  return { rows, goals, text };
}
