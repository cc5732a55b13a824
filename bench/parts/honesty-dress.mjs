// One step of a dress as users bring them, by each solver, and of easier and worse ones.
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { tell } from './bench-parts.mjs';
import { goal, markdown, median, short } from './bench-rows.mjs';
import { ask } from './command.mjs';
import { crumpledDress } from './crumpled-dress.mjs';

const kTolerance = 1e-3; // of the step's equations
const kStep = 1 / 60; // [s]
const kSteps = 2; // timed, after the first

// [vertices of a ring, rings of a flounce, flounces]
const kDress = [190, 25, 6];
const kDresses = {
  'dress of six flounces': { size: kDress, solvers: ['supernodal', 'cholmod', 'cg'] },
  'dress of one piece': { size: [190, 150, 1], solvers: ['supernodal', 'cg'] },
  'half as fine, six flounces': { size: [96, 12, 6], solvers: ['supernodal', 'cholmod', 'cg'] },
};

/** A step of the dress by a solver: its milliseconds and what is left of its equations. */
function measured(file, solver, label, n_vertices) {
  const scene = {
    name: label,
    cloth: { mesh: { obj: file, warp_direction: [0, -1, 0] } },
    fabric: { name: 'fine cotton' },
    pins: [{ part: 'seam' }],
    method: { stepper: 'implicit', step_s: kStep, solver, tolerance: kTolerance },
  };
  const run = ask('bench', 'run', scene, '--frames', kSteps + 1);
  const { first_ms, residual, status, message } = run;
  const ms = Math.max(first_ms, median(run.ms)); // cg starts from the last step's changes
  // A residual of 0 was not computed.
  return { scene: label, solver, n_vertices, ms, residual: residual || null, status, message };
}

export async function dress({ scale }) {
  const folder = mkdtempSync(join(tmpdir(), 'pleat-dress-'));
  const rows = [];
  try {
    for (const [label, { size, solvers }] of Object.entries(kDresses)) {
      const file = join(folder, 'dress.obj');
      writeFileSync(file, crumpledDress(...size));
      const n_vertices = size.reduce((product, n) => product * n);
      for (const solver of solvers) {
        tell(`${label}, ${solver}`);
        rows.push(measured(file, solver, label, n_vertices));
      }
    }
  } finally {
    rmSync(folder, { recursive: true });
  }
  const head = ['cloth', 'vertices', 'solver', 'ms/step', 'residual', 'status'];
  const lines = rows.map((row) => [
    row.scene,
    row.n_vertices,
    row.solver,
    short(row.ms),
    short(row.residual ?? Number.NaN),
    row.status,
  ]);
  const [ours] = rows;
  const goals = [
    goal('truth.dress_step_ms', ours.ms, 'at-most', 3000 * scale, [ours]),
    goal('truth.dress_residual', ours.residual, 'at-most', kTolerance, [ours]),
  ];
  const text = `one step of ${short(1e3 * kStep)} ms, the slowest of the first and later ones, with analysis\n\n${markdown(head, lines)}`;
  return { rows, goals, text };
}
