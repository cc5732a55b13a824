// Processor time to make the levels of meshes of 10 000 vertices and slightly more.
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { atMost, inTurn, medianRow, spread, table } from './bench-rows.mjs';
import { ask, commit, inFolder } from './command.mjs';
import { crumpledDress } from './crumpled-dress.mjs';
import { horizontal, walking } from './multigrid-preconditioner.mjs';
import { kEdge } from './sheets.mjs';

const kMostMs = 150;

/** A row of each mesh: a scene or an OBJ file. */
const rowsOf = (repeat) =>
  inFolder(async (folder) => {
    const file = join(folder, 'crumpled.obj');
    writeFileSync(file, crumpledDress(100, 100, 1));
    const { substeps, ...skirt } = walking('skirt', 2);
    const meshes = {
      'sheet 100x100': horizontal(100, kEdge),
      'skirt in a walk': skirt,
      'crumpled dress, no two triangles alike': file,
    };
    const contestants = Object.entries(meshes).map(([mesh, about]) => ({
      label: `hierarchy of ${mesh}`,
      run: () => ask('hierarchy', about, '--json'),
    }));
    const runs = await inTurn(repeat, contestants);
    return Object.keys(meshes).map((scene, i) => {
      const { levels, shortage, processor_ms } = medianRow(runs[i], ['processor_ms']);
      return {
        scene,
        n_vertices: levels.map((level) => level.n_vertices),
        processor_ms,
        spread_ms: spread(runs[i].map((run) => run.processor_ms)),
        status: shortage ? 'short of levels' : 'ok',
        commit,
      };
    });
  });

export async function hierarchy({ repeat, scale }) {
  const rows = await rowsOf(repeat);
  const columns = {
    mesh: 'scene',
    vertices: (row) => row.n_vertices.join(', '),
    ms: 'processor_ms',
    spread: 'spread_ms',
    status: 'status',
  };
  const slowest = Math.max(...rows.map((row) => row.processor_ms));
  return {
    rows,
    goals: [atMost('hierarchy_10000_ms', slowest, kMostMs * scale, rows)],
    text: `processor time to make three coarser levels; median of ${repeat}\n\n${table(rows, columns)}`,
  };
}
