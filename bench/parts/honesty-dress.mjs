// One step of a dress as users bring them, by each solver, and of easier and worse ones.
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { tell } from './bench-options.mjs';
import { atMost, median, short, table } from './bench-rows.mjs';
import { inFolder, nativeRun } from './command.mjs';
import { crumpledDress, dressScene } from './crumpled-dress.mjs';
import { by, kStep } from './sheets.mjs';

const kTolerance = 1e-3; // tolerance of the step's equations
const kSteps = 2; // timed, after the first

// [vertices of a ring, rings of a flounce, flounces]
const kDresses = {
  'dress of six flounces': { size: [190, 25, 6], solvers: ['supernodal', 'cholmod', 'cg'] },
  'dress of one piece': { size: [190, 150, 1], solvers: ['supernodal', 'cg'] },
  'half as fine, six flounces': { size: [96, 12, 6], solvers: ['supernodal', 'cholmod', 'cg'] },
};

/** A step of the dress by a solver: its milliseconds and what is left of its equations. */
function measured(file, solver, scene, n_vertices) {
  tell(`${scene}, ${solver}`);
  const method = { stepper: 'implicit', solver, tolerance: kTolerance };
  const run = nativeRun(by({ name: scene, ...dressScene(file) }, method), kSteps + 1);
  const { first_ms, ms, residual, status, message } = run;
  return {
    scene,
    solver,
    n_vertices,
    ms: Math.max(first_ms, median(ms)), // cg starts from the last step's changes
    residual: residual || null, // a residual of 0 was not computed
    status,
    message,
  };
}

export async function dress({ scale }) {
  const rows = inFolder((folder) =>
    Object.entries(kDresses).flatMap(([label, { size, solvers }]) => {
      const file = join(folder, 'dress.obj');
      writeFileSync(file, crumpledDress(...size));
      const n_vertices = size.reduce((product, n) => product * n);
      return solvers.map((solver) => measured(file, solver, label, n_vertices));
    }),
  );
  const columns = {
    cloth: 'scene',
    vertices: 'n_vertices',
    solver: 'solver',
    'ms/step': 'ms',
    residual: 'residual',
    status: 'status',
  };
  const [ours] = rows;
  return {
    rows,
    goals: [
      atMost('dress_step_ms', ours.ms, 3000 * scale, [ours]),
      atMost('dress_residual', ours.residual, kTolerance, [ours]),
    ],
    text: `one step of ${short(1e3 * kStep)} ms, the slowest of the first and later ones, with analysis\n\n${table(rows, columns)}`,
  };
}
