// A fine sheet that falls on a ball. A sweep carries a pull by a few of its cells: what that leaves
// unsolved the run has to tell, and what it advises has to mend.
import { changed } from './assets.mjs';
import { tell } from './bench-options.mjs';
import { atMost, table } from './bench-rows.mjs';
import { ran } from './command.mjs';
import { toldOf } from './same-cloth-runs.mjs';
import { lyingSheet, withStepper } from './same-cloth-scenes.mjs';

const kCells = 223;
const kSteppers = ['multigrid', 'projective', 'xpbd', 'pbd', 'hpbd', 'implicit'];
const kMostChanges = 3;
/** RMS stretch at the end that is wrong: ten times that of `implicit`. */
const kWrong = 0.01;

const sheet = {
  name: `${(kCells + 1) ** 2} vertices on a ball`,
  cloth: lyingSheet(kCells, 1, [-0.5, 1, -0.5]),
  fabric: { name: 'linen' },
  world: { air: {}, colliders: [{ sphere: { centre_m: [0, 0.74, 0], radius_m: 0.25 } }] },
  record: { format: 'none' },
  duration_s: 1 / 3,
};

/** Row of one run, with the scenes that follow what it advises. */
function ended(stepper, change, scene) {
  tell(`${stepper}, ${change}`);
  const metrics = JSON.parse(ran(['run', scene, '--json'], 'ignore').stdout);
  const told = toldOf(metrics);
  const row = {
    case: sheet.name,
    stepper,
    change,
    method: metrics.method,
    largest_stretch: metrics.largest_stretch,
    rms_stretch: metrics.rms_stretch_at_end,
    told,
    verdict: metrics.rms_stretch_at_end <= kWrong ? 'ok' : told.length > 0 ? 'warned' : 'WRONG',
    status: metrics.status,
    n_vertices: metrics.n_vertices,
    core: metrics.core,
    reference: { id: 'implicit', description: 'RMS stretch of the row of implicit' },
  };
  const next = Object.entries(metrics.warnings[0]?.hints ?? {}).map(([pointer, value]) => ({
    change: `${pointer} ${JSON.stringify(value)}`,
    scene: changed(scene, { [pointer]: value }),
  }));
  return { row, next };
}

/** Rows of a stepper at its defaults, then with each change that its warnings advise. */
function followed(stepper, seen) {
  const rows = [];
  let runs = [{ change: 'defaults', scene: withStepper(sheet, stepper) }];
  for (let change = 0; change <= kMostChanges; ++change) {
    const fresh = runs.filter(({ scene }) => !seen.has(JSON.stringify(scene.method)));
    for (const { scene } of fresh) seen.add(JSON.stringify(scene.method));
    const done = fresh.map((run) => ended(stepper, run.change, run.scene));
    rows.push(...done.map(({ row }) => ({ ...row, n_changes: change })));
    runs = done.flatMap(({ next }) => next);
  }
  return rows;
}

/** Rows of all steppers; a change that several of them advise is run once. */
export function fineSheets() {
  const seen = new Set();
  const rows = kSteppers.flatMap((stepper) => followed(stepper, seen));
  const counted = (fits) => rows.filter(fits).length;
  const columns = {
    stepper: 'stepper',
    changes: 'n_changes',
    'last change': 'change',
    'largest %': (row) => 100 * row.largest_stretch,
    'rms %': (row) => 100 * row.rms_stretch,
    told: (row) => row.told.join(', ') || '-',
    verdict: 'verdict',
  };
  return {
    rows,
    goals: [
      atMost(
        'silent_wrong_large',
        counted(({ verdict }) => verdict === 'WRONG'),
        0,
        rows,
      ),
      atMost(
        'told_after_three_changes_large',
        counted((row) => row.n_changes === kMostChanges && row.told.length > 0),
        0,
        rows,
      ),
    ],
    text: `${sheet.name}, linen, 1 m, ${sheet.duration_s.toFixed(2)} s\n\n${table(rows, columns)}`,
  };
}
