// ./pleat bench modes (--help tells the options)
// Frames between key shapes: what they cost, natively and in WebAssembly, what they keep, and how
// near they are to a simulation's.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

import { shippedScene } from './parts/assets.mjs';
import { tell } from './parts/bench-options.mjs';
import { runParts } from './parts/bench-parts.mjs';
import { atMost, exponent, inTurn, medianRow, table } from './parts/bench-rows.mjs';
import { ask, inFolder, printed } from './parts/command.mjs';
import { answer, wasmModule } from './parts/contestants.mjs';
import { barKeys, sheetKeys } from './parts/key-shapes.mjs';

const kFrames = 120;

/** Keys come back to where they were, and go on. */
const kBarAngles = [1, 2, 3, 2.5, 1.5, 0.5, -1]; // [rad]

const withStatus = (found) => ({
  status: found.unconverged > 0 ? 'not_converged' : 'ok',
  ...found,
});

/** A completion as `pleat bench inbetween` tells it. */
const completed = (files, frames, options = []) =>
  withStatus(ask('bench', 'inbetween', '--frames', frames, ...options, ...files));

/** A completion in WebAssembly, of keys that are OBJ files of one mesh. */
async function completedInWasm(files) {
  const module = await wasmModule();
  const keys = files.map((file) => readFileSync(file, 'utf8'));
  return withStatus({ ...answer(module.completionCost(keys, kFrames)), target: 'wasm' });
}

/** Rows of [{label, run}] in turn. */
async function timed(contestants, repeat) {
  const times = ['precompute_ms', 'middle_ms', 'middles_ms', 'surfaces_ms'];
  const runs = await inTurn(repeat, contestants);
  return runs.map((of, i) => ({ ...medianRow(of, times), label: contestants[i].label }));
}

/** A bar bent by 180 degrees, and others: what is kept between the keys. */
const bar = () =>
  inFolder((folder) => {
    const kBars = {
      'bar of 1 x 0.15 x 0.15 m, 180 degrees': [[1, 0.15, 0.15], [60, 9, 9], [Math.PI]],
      'thick bar of 1 x 0.3 x 0.3 m, 120 degrees': [[1, 0.3, 0.3], [40, 12, 12], [2.094]],
      'flat bar of 1 x 0.06 x 0.3 m, 180 degrees': [[1, 0.06, 0.3], [60, 4, 18], [Math.PI]],
      'bar of 1 x 0.15 x 0.15 m, 300 degrees': [[1, 0.15, 0.15], [60, 9, 9], [5.236]],
    };
    const rows = Object.entries(kBars).map(([label, shape]) => {
      tell(label);
      return { label, ...completed(barKeys(folder, ...shape), 17) };
    });
    const columns = {
      keys: 'label',
      tetrahedra: 'n_tets',
      'volume changes by at most %': ({ figures }) => 100 * figures.volume_change,
      'linear %': ({ linear }) => 100 * linear.volume_change,
      inverted: ({ figures }) => figures.inverted,
      linear: ({ linear }) => linear.inverted,
      'halves differ by at most %': ({ figures }) => 100 * figures.unequal_halves,
    };
    const [row] = rows;
    const { volume_change, inverted, unequal_halves } = row.figures;
    const goals = [
      atMost('bar_volume_change_percent', 100 * volume_change, 2, [row]),
      atMost('bar_inverted_tetrahedra', inverted, 0, [row]),
      atMost('bar_unequal_halves_percent', 100 * unequal_halves, 1, [row]),
    ];
    return { rows, goals, text: `\n\n${table(rows, columns)}` };
  });

/** The first second of a shipped scene in frames of 1/60 s; `keys` picks those that are known. */
function sequence(folder, name, keys) {
  const scene = { ...shippedScene(name), record: { format: 'obj', every_s: 1 / 60 } };
  const frames = join(folder, `${name}.frames`);
  tell(`${name}: simulation`);
  printed('run', '--json', '--duration', 59 / 60, '--out', frames, '--overwrite', scene);
  const file = (k) => join(frames, `frame_${String(k).padStart(6, '0')}.obj`);
  const label = `${name}, keys ${keys.join(', ')}`;
  tell(label);
  return { label, ...completed(keys.map(file), 60, ['--against', frames, '--unreduced']) };
}

/** Draping cloth: four of sixty frames are keys, the others are filled in. */
const cloth = () =>
  inFolder((folder) => {
    const spread = [0, 20, 40, 59];
    const dense = [20, 30, 40, 50];
    const rows = ['swinging_sheet', 'tablecloth', 'curtain'].flatMap((name) =>
      [spread, dense].map((keys) => sequence(folder, name, keys)),
    );
    const toLinear = (row) => row.distance_m / row.linear.distance_m;
    const toUnreduced = (row) => row.distance_m / row.unreduced.distance_m;
    const time = (row) => row.middles_ms / row.unreduced.middles_ms;
    const columns = {
      sequence: 'label',
      'RMS to the nearest simulated frame mm': (row) => 1e3 * row.distance_m,
      'linear mm': (row) => 1e3 * row.linear.distance_m,
      'unreduced mm': (row) => 1e3 * row.unreduced.distance_m,
      'over linear': toLinear,
      'over unreduced': toUnreduced,
      'middles ms': 'middles_ms',
      'unreduced ms': (row) => row.unreduced.middles_ms,
    };
    const [row] = rows;
    const most = (ratio) => Math.max(...rows.map(ratio));
    const goals = [
      atMost('sheet_distance_to_linear', toLinear(row), 0.5, [row]),
      atMost('sheet_distance_to_unreduced', toUnreduced(row), 1.2, [row]),
      atMost('sheet_time_to_unreduced', time(row), 0.1, [row]),
      atMost('all_sequences_distance_to_unreduced', most(toUnreduced), 1.2, rows),
      atMost('all_sequences_time_to_unreduced', most(time), 0.1, rows),
    ];
    return { rows, goals, text: `\n\n${table(rows, columns)}` };
  });

function costText(rows) {
  const columns = {
    keys: 'label',
    vertices: 'n_vertices',
    'of the volume': 'n_volume_vertices',
    'precomputation ms per key': (row) => row.precompute_ms / row.n_keys,
    'one middle ms': 'middle_ms',
    'all middles ms': 'middles_ms',
    'surfaces ms': 'surfaces_ms',
  };
  return `\n\n${table(rows, columns)}`;
}

/** Rows of 10 000 vertices, 8 keys, 120 frames. */
const largeRows = (repeat, completion) =>
  inFolder((folder) => {
    const keys = {
      'rolled sheet': sheetKeys(folder, 100, 8),
      'bent bar': barKeys(folder, [1, 0.2, 0.2], [110, 22, 22], kBarAngles),
    };
    const contestants = Object.entries(keys).map(([label, files]) => ({
      label,
      run: () => completion(files, kFrames),
    }));
    return timed(contestants, repeat);
  });

async function large({ repeat, scale }) {
  const rows = await largeRows(repeat, completed);
  const most = (of) => Math.max(...rows.map(of));
  const middle = most((row) => row.middle_ms);
  const middles = most((row) => row.middles_ms);
  const perKey = most((row) => row.precompute_ms / row.n_keys);
  const goals = [
    atMost('middle_10000_ms', middle, 10 * scale, rows),
    atMost('frames_120_of_8_keys_ms_native', middles, 400 * scale, rows),
    atMost('precompute_per_key_10000_ms', perKey, 6000 * scale, rows),
  ];
  return { rows, goals, text: costText(rows) };
}

/** A sheet and a bar, more and more finely cut. */
const growth = ({ repeat }) =>
  inFolder(async (folder) => {
    const sheet = (n) => {
      const files = sheetKeys(folder, n, 3);
      return { label: `sheet ${n} x ${n}`, run: () => completed(files, kFrames) };
    };
    const lattice = (n) => {
      const files = barKeys(folder, [1, 0.2, 0.2], [n, n / 5, n / 5], [1, 2]);
      const run = () => completed(files, kFrames, ['--size', 1 / n]);
      return { label: `bar in a lattice of 1/${n} m`, run };
    };
    const sheets = await timed([20, 35, 60, 100].map(sheet), repeat);
    const bars = await timed([20, 30, 40, 50].map(lattice), repeat);
    const slope = (rows) =>
      exponent(rows.map(({ n_volume_vertices, middle_ms }) => [n_volume_vertices, middle_ms]));
    const rows = [...sheets, ...bars];
    const goals = [
      atMost('middle_growth_exponent_sheet', slope(sheets), 0.3, sheets),
      atMost('middle_growth_exponent_bar', slope(bars), 0.3, bars),
    ];
    return { rows, goals, text: costText(rows) };
  });

/** The sheet and the bar of `large`, in the page's module. */
async function wasm({ repeat, scale }) {
  const rows = await largeRows(repeat, completedInWasm);
  const most = Math.max(...rows.map((row) => row.middles_ms));
  const goals = [atMost('frames_120_of_8_keys_ms_wasm', most, 1000 * scale, rows)];
  return { rows, goals, text: costText(rows) };
}

await runParts('modes', 'frames between key shapes', { bar, cloth, large, growth, wasm });
