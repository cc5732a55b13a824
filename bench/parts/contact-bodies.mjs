// Distances from a closed mesh: what makes and asks them costs, and whether they are right.
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { atMost, largest, median, spread, table } from './bench-rows.mjs';
import { ask, commit, inFolder } from './command.mjs';

const kAround = 50; // quads around a ring, and rings: 5 000 triangles
const kRadii = [0.3, 0.1]; // m
const kPlaces = 10_000;
const kMostMs = 100; // ms, with what is made once
const kMostMb = 16;

/** A ring as an OBJ file: closed, and nowhere convex inside. */
function ringObj(n) {
  const lines = [];
  const angle = (k) => (2 * Math.PI * k) / n;
  for (let i = 0; i < n; ++i)
    for (let k = 0; k < n; ++k) {
      const off = kRadii[0] + kRadii[1] * Math.cos(angle(k));
      const height = kRadii[1] * Math.sin(angle(k));
      lines.push(`v ${off * Math.cos(angle(i))} ${height} ${off * Math.sin(angle(i))}`);
    }
  const vertex = (i, k) => 1 + (i % n) * n + (k % n);
  for (let i = 0; i < n; ++i)
    for (let k = 0; k < n; ++k) {
      const [a, b, c, d] = [vertex(i, k), vertex(i, k + 1), vertex(i + 1, k + 1), vertex(i + 1, k)];
      lines.push(`f ${a} ${b} ${c}`, `f ${a} ${c} ${d}`);
    }
  return `${lines.join('\n')}\n`;
}

const kColumns = {
  body: 'body',
  triangles: 'n_triangles',
  places: 'n_places',
  'made ms': 'build_ms',
  'asked ms': 'query_ms',
  'all ms': 'ms',
  spread: 'spread_ms',
  MB: (row) => row.bytes / 1e6,
  'error m': 'largest_error_m',
  'wrong sides': 'n_wrong_sides',
};

export async function bodies({ repeat, scale }) {
  const runs = inFolder((folder) => {
    const file = join(folder, 'ring.obj');
    writeFileSync(file, ringObj(kAround));
    return Array.from({ length: repeat }, () =>
      ask('bench', 'depth', file, '--places', String(kPlaces)),
    );
  });
  const all = runs.map(({ build_ms, query_ms }) => build_ms + query_ms);
  const rows = [
    {
      body: 'ring',
      ...runs[0],
      build_ms: median(runs.map(({ build_ms }) => build_ms)),
      query_ms: median(runs.map(({ query_ms }) => query_ms)),
      ms: median(all),
      spread_ms: spread(all),
      status: 'ok',
      reference: { id: 'winding', description: 'triangle by triangle, and by the winding number' },
      commit,
    },
  ];
  const goals = [
    atMost('signed_distance_5000_ms', rows[0].ms, kMostMs * scale, rows),
    atMost('signed_distance_5000_mb', rows[0].bytes / 1e6, kMostMb, rows),
    atMost('signed_distance_error_m', largest(rows.map((row) => row.largest_error_m)), 1e-12, rows),
    atMost('signed_distance_wrong_sides', rows[0].n_wrong_sides, 0, rows),
  ];
  return { rows, goals, text: table(rows, kColumns) };
}
