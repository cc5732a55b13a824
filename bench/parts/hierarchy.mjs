// Processor time to make the levels of meshes of 10 000 vertices and slightly more.
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { commit, tell } from './bench-parts.mjs';
import { goal, markdown, median, short } from './bench-rows.mjs';
import { ask } from './command.mjs';
import { crumpledDress } from './crumpled-dress.mjs';
import { walking } from './multigrid-preconditioner.mjs';
import { squareSheet } from './square-sheet.mjs';

const kMostMs = 150;

/** [what its row is called, a scene or an OBJ file] */
const meshesOf = (folder) => {
  const file = join(folder, 'crumpled.obj');
  writeFileSync(file, crumpledDress(100, 100, 1));
  const sheet = {
    cloth: squareSheet(100, [0, 1.5, 0], [1, 0, 0], [0, 0, 1]),
    fabric: { name: 'fine cotton' },
    pins: [{ part: 'upper_edge' }],
  };
  const { substeps, ...skirt } = walking('skirt', 2);
  return [
    ['sheet 100x100', sheet],
    ['skirt in a walk', skirt],
    ['crumpled dress, no two triangles alike', file],
  ];
};

export async function hierarchy({ repeat, scale }) {
  const folder = mkdtempSync(join(tmpdir(), 'pleat-hierarchy-'));
  const rows = [];
  try {
    for (const [mesh, about] of meshesOf(folder)) {
      tell(`hierarchy of ${mesh}`);
      const runs = Array.from({ length: repeat }, () => ask('hierarchy', about, '--json'));
      const ms = runs.map((run) => run.processor_ms);
      rows.push({
        scene: mesh,
        n_vertices: runs[0].levels.map((level) => level.n_vertices),
        processor_ms: median(ms),
        spread_ms: Math.max(...ms) - Math.min(...ms),
        status: runs[0].shortage ? 'short of levels' : 'ok',
        commit,
      });
    }
  } finally {
    rmSync(folder, { recursive: true });
  }
  const lines = rows.map((row) => [
    row.scene,
    row.n_vertices.join(', '),
    short(row.processor_ms),
    short(row.spread_ms),
    row.status,
  ]);
  const slowest = Math.max(...rows.map((row) => row.processor_ms));
  return {
    rows,
    goals: [goal('multigrid.hierarchy_10000_ms', slowest, 'at-most', kMostMs * scale, rows)],
    text: `processor time to make three coarser levels; median of ${repeat}\n\n${markdown(['mesh', 'vertices', 'ms', 'spread', 'status'], lines)}`,
  };
}
