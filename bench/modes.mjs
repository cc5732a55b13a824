// ./pleat bench modes (--help tells the options)
// Frames between key shapes: what they cost, natively and in WebAssembly, what they keep, and how
// near they are to a simulation's.
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { runParts, tell } from './parts/bench-parts.mjs';
import { exponent, goal, markdown, median, short } from './parts/bench-rows.mjs';
import { ask, printed, root } from './parts/command.mjs';
import { completionWasm } from './parts/contestants.mjs';
import { barKeys, sheetKeys } from './parts/key-shapes.mjs';

const kFrames = 120;
const kKeys = 8;

/** Keys come back to where they were, and go on. */
const kBarAngles = [1, 2, 3, 2.5, 1.5, 0.5, -1]; // [rad]

/** Does `work` with a folder that is gone afterwards. */
async function inFolder(work) {
  const folder = mkdtempSync(join(tmpdir(), 'pleat-bench-'));
  try {
    return await work(folder);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** One row: a completion as `pleat bench inbetween` tells it. */
function completed(label, files, frames, options = []) {
  tell(label);
  const found = ask('bench', 'inbetween', '--frames', frames, ...options, ...files);
  return { label, status: found.unconverged > 0 ? 'not_converged' : 'ok', ...found };
}

/** One row of several runs: times are medians, the rest is the same in all. */
function medians(label, runs) {
  const times = ['precompute_ms', 'middle_ms', 'middles_ms', 'surfaces_ms'];
  return {
    ...runs[0],
    label,
    ...Object.fromEntries(times.map((key) => [key, median(runs.map((run) => run[key]))])),
  };
}

/** Contestants in turn. */
function timed(contestants, repeat) {
  const runs = contestants.map(() => []);
  for (let round = 0; round < repeat; ++round)
    for (const [i, { label, files, options }] of contestants.entries())
      runs[i].push(completed(`${label}, round ${round + 1} of ${repeat}`, files, kFrames, options));
  return runs.map((of, i) => medians(contestants[i].label, of));
}

const percent = (share) => short(100 * share);

/** A bar bent by 180 degrees, and others: what is kept between the keys. */
async function bar() {
  return inFolder((folder) => {
    const kBars = [
      ['bar of 1 x 0.15 x 0.15 m, 180 degrees', [1, 0.15, 0.15], [60, 9, 9], [Math.PI]],
      ['thick bar of 1 x 0.3 x 0.3 m, 120 degrees', [1, 0.3, 0.3], [40, 12, 12], [2.094]],
      ['flat bar of 1 x 0.06 x 0.3 m, 180 degrees', [1, 0.06, 0.3], [60, 4, 18], [Math.PI]],
      ['bar of 1 x 0.15 x 0.15 m, 300 degrees', [1, 0.15, 0.15], [60, 9, 9], [5.236]],
    ];
    const rows = kBars.map(([label, sides, cells, angles]) =>
      completed(label, barKeys(folder, sides, cells, angles), 17),
    );
    const [row] = rows;
    const head = [
      'keys',
      'tetrahedra',
      'volume changes by at most %',
      'linear %',
      'inverted',
      'linear',
      'halves differ by at most %',
    ];
    const lines = rows.map(({ label, n_tets, figures, linear }) => [
      label,
      n_tets,
      percent(figures.volume_change),
      percent(linear.volume_change),
      figures.inverted,
      linear.inverted,
      percent(figures.unequal_halves),
    ]);
    return {
      rows,
      goals: [
        goal('bar_volume_change_percent', 100 * row.figures.volume_change, 'at-most', 2, [row]),
        goal('bar_inverted_tetrahedra', row.figures.inverted, 'at-most', 0, [row]),
        goal('bar_unequal_halves_percent', 100 * row.figures.unequal_halves, 'at-most', 1, [row]),
      ],
      text: `\n\n${markdown(head, lines)}`,
    };
  });
}

/** The first second of a shipped scene in frames of 1/60 s; `keys` picks those that are known. */
function sequence(folder, name, keys) {
  const scene = JSON.parse(readFileSync(join(root, 'assets', 'scenes', `${name}.json`)));
  scene.record = { format: 'obj', every_s: 1 / 60 };
  const frames = join(folder, `${name}.frames`);
  tell(`${name}: simulation`);
  printed('run', '--json', '--duration', 59 / 60, '--out', frames, '--overwrite', scene);
  const file = (k) => join(frames, `frame_${String(k).padStart(6, '0')}.obj`);
  const label = `${name}, keys ${keys.join(', ')}`;
  const options = ['--against', frames, '--unreduced'];
  return completed(label, keys.map(file), 60, options);
}

/** Draping cloth: four of sixty frames are keys, the others are filled in. */
async function cloth() {
  return inFolder((folder) => {
    const spread = [0, 20, 40, 59];
    const dense = [20, 30, 40, 50];
    const rows = ['swinging_sheet', 'tablecloth', 'curtain'].flatMap((name) =>
      [spread, dense].map((keys) => sequence(folder, name, keys)),
    );
    const ratios = (row) => ({
      linear: row.distance_m / row.linear.distance_m,
      unreduced: row.distance_m / row.unreduced.distance_m,
      time: row.middles_ms / row.unreduced.middles_ms,
    });
    const [row] = rows;
    const head = [
      'sequence',
      'RMS to the nearest simulated frame mm',
      'linear mm',
      'unreduced mm',
      'over linear',
      'over unreduced',
      'middles ms',
      'unreduced ms',
    ];
    const lines = rows.map((of) => [
      of.label,
      short(1e3 * of.distance_m),
      short(1e3 * of.linear.distance_m),
      short(1e3 * of.unreduced.distance_m),
      short(ratios(of).linear),
      short(ratios(of).unreduced),
      short(of.middles_ms),
      short(of.unreduced.middles_ms),
    ]);
    const most = (key) => Math.max(...rows.map((of) => ratios(of)[key]));
    return {
      rows,
      goals: [
        goal('sheet_distance_to_linear', ratios(row).linear, 'at-most', 0.5, [row]),
        goal('sheet_distance_to_unreduced', ratios(row).unreduced, 'at-most', 1.2, [row]),
        goal('sheet_time_to_unreduced', ratios(row).time, 'at-most', 0.1, [row]),
        goal('all_sequences_distance_to_unreduced', most('unreduced'), 'at-most', 1.2, rows),
        goal('all_sequences_time_to_unreduced', most('time'), 'at-most', 0.1, rows),
      ],
      text: `\n\n${markdown(head, lines)}`,
    };
  });
}

function costTable(rows) {
  const head = [
    'keys',
    'vertices',
    'of the volume',
    'precomputation ms per key',
    'one middle ms',
    'all middles ms',
    'surfaces ms',
  ];
  return markdown(
    head,
    rows.map((row) => [
      row.label,
      row.n_vertices,
      row.n_volume_vertices,
      short(row.precompute_ms / row.n_keys),
      short(row.middle_ms),
      short(row.middles_ms),
      short(row.surfaces_ms),
    ]),
  );
}

/** 10 000 vertices, 8 keys, 120 frames. */
async function large({ repeat, scale }) {
  return inFolder((folder) => {
    const rows = timed(
      [
        { label: 'rolled sheet', files: sheetKeys(folder, 100, kKeys) },
        { label: 'bent bar', files: barKeys(folder, [1, 0.2, 0.2], [110, 22, 22], kBarAngles) },
      ],
      repeat,
    );
    const most = (of) => Math.max(...rows.map(of));
    const perKey = most((row) => row.precompute_ms / row.n_keys);
    return {
      rows,
      goals: [
        goal(
          'middle_10000_ms',
          most((row) => row.middle_ms),
          'at-most',
          10 * scale,
          rows,
        ),
        goal(
          'frames_120_of_8_keys_ms_native',
          most((row) => row.middles_ms),
          'at-most',
          400 * scale,
          rows,
        ),
        goal('precompute_per_key_10000_ms', perKey, 'at-most', 6000 * scale, rows),
      ],
      text: `\n\n${costTable(rows)}`,
    };
  });
}

/** The same sheet and bar, more and more finely cut. */
async function growth({ repeat }) {
  return inFolder((folder) => {
    const kAcross = [20, 35, 60, 100];
    const sheets = timed(
      kAcross.map((n) => ({ label: `sheet ${n} x ${n}`, files: sheetKeys(folder, n, 3) })),
      repeat,
    );
    const kCells = [20, 30, 40, 50];
    const bars = timed(
      kCells.map((n) => ({
        label: `bar in a lattice of 1/${n} m`,
        files: barKeys(folder, [1, 0.2, 0.2], [n, n / 5, n / 5], [1, 2]),
        options: ['--size', 1 / n],
      })),
      repeat,
    );
    const slope = (rows) =>
      exponent(rows.map(({ n_volume_vertices, middle_ms }) => [n_volume_vertices, middle_ms]));
    return {
      rows: [...sheets, ...bars],
      goals: [
        goal('middle_growth_exponent_sheet', slope(sheets), 'at-most', 0.3, sheets),
        goal('middle_growth_exponent_bar', slope(bars), 'at-most', 0.3, bars),
      ],
      text: `\n\n${costTable([...sheets, ...bars])}`,
    };
  });
}

/** The sheet and the bar of `large`, in the page's module. */
async function wasm({ repeat, scale }) {
  return inFolder(async (folder) => {
    const kCases = [
      ['rolled sheet', sheetKeys(folder, 100, kKeys)],
      ['bent bar', barKeys(folder, [1, 0.2, 0.2], [110, 22, 22], kBarAngles)],
    ];
    const rows = [];
    for (const [label, files] of kCases) {
      const runs = [];
      for (let round = 0; round < repeat; ++round) {
        tell(`${label}, wasm, round ${round + 1} of ${repeat}`);
        runs.push(await completionWasm(files, kFrames));
      }
      rows.push(medians(label, runs));
    }
    return {
      rows,
      goals: [
        goal(
          'frames_120_of_8_keys_ms_wasm',
          Math.max(...rows.map((row) => row.middles_ms)),
          'at-most',
          1000 * scale,
          rows,
        ),
      ],
      text: `\n\n${costTable(rows)}`,
    };
  });
}

await runParts('modes', 'frames between key shapes', { bar, cloth, large, growth, wasm });
