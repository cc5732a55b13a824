// Strips of the fifteen fabrics over an edge, run to rest by the page's WebAssembly: whether they are
// sorted as the heavy elastica sorts them.
import { fabricsText, shippedScene } from './assets.mjs';
import { tell } from './bench-options.mjs';
import { atLeast, atMost, largest, table } from './bench-rows.mjs';
import { reference } from './command.mjs';
import { answer, wasmModule } from './contestants.mjs';
import { fabricNames } from './same-cloth-scenes.mjs';

const kLongest = 3600; // steps
const kAtOnce = 15;
const kRest = 2e-6; // [m] by which a tip at rest moves in kAtOnce steps, twice in a row
const kLargestError = 1; // degrees

/** The strip's droop: the angle of its tip's middle below the edge, which lies at the origin [degrees]. */
function droop(positions, columns) {
  const last = Array.from(positions.slice(-3 * (columns + 1)));
  const mean = (axis) =>
    last.reduce((sum, x, k) => sum + (k % 3 === axis ? x : 0), 0) / (columns + 1);
  return (180 / Math.PI) * Math.atan2(-mean(1), mean(2));
}

/** Positions at rest, and the time that it took [s]. */
function letDown(module, scene) {
  const run = new module.Simulation(fabricsText());
  answer(run.load(JSON.stringify(scene)));
  const tip = () => run.positions().slice(-3);
  let still = 0;
  let step = 0;
  for (; step < kLongest && still < 2; step += kAtOnce) {
    const before = tip();
    run.step(kAtOnce);
    const way = Math.hypot(...tip().map((x, k) => x - before[k]));
    still = way < kRest ? still + 1 : 0;
  }
  const { status } = answer(run.status());
  const { time_s, warnings } = answer(run.numbers());
  const positions = run.positions().slice();
  run.delete();
  return { positions, time_s, status: still < 2 ? 'not at rest' : status, warnings };
}

export async function strips() {
  const module = await wasmModule();
  const scene = shippedScene('strip');
  const { columns } = scene.cloth.sheet;
  const rows = fabricNames().map((name) => {
    tell(`strip of ${name}`);
    const fabric = { name };
    const { positions, ...run } = letDown(module, { ...scene, fabric });
    const { world, ...airless } = scene; // air does nothing at rest
    const [{ positions_m }] = reference({ ...airless, fabric }, 'closed_form', [1]).samples;
    const right = droop(positions_m, columns);
    return { name, droop: droop(positions, columns), right, ...run };
  });
  const order = (key) => [...rows].sort((a, b) => a[key] - b[key]).map(({ name }) => name);
  const right = order('right');
  const sorted = order('droop').filter((name, place) => name === right[place]);
  const errors = rows.map((row) => Math.abs(row.droop - row.right));
  const columnsOfTable = {
    fabric: 'name',
    'droops by': ({ droop: angle }) => angle.toFixed(2),
    elastica: ({ right: angle }) => angle.toFixed(2),
    'at rest after s': 'time_s',
    told: ({ warnings }) => warnings.map(({ kind }) => kind).join() || '-',
  };
  return {
    rows,
    goals: [
      atLeast('strips_sorted_as_elastica', sorted.length, 15, rows),
      atMost('strips_error_degrees', largest(errors), kLargestError, rows),
    ],
    text: `strips over an edge, angles in degrees, the stiffest first\n\n${table(
      [...rows].sort((a, b) => a.droop - b.droop),
      columnsOfTable,
    )}`,
  };
}
