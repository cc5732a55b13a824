// What hierarchies are without the guards of their collapses: faults of each level, and a picture
// of right beside wrong.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { commit, tell } from './bench-parts.mjs';
import { goal, markdown, short } from './bench-rows.mjs';
import { ask, root } from './command.mjs';
import { guardsFigure } from './guards-figure.mjs';

const kFigureFile = join('docs', 'hierarchy-guards.svg');
const kMeshes = {
  'flat sheet': 'falling_sheet.json',
  skirt: join('garments', 'skirt_walk.json'),
  trousers: join('garments', 'trousers_walk.json'),
};
const kWithout = ['', 'flips', 'borders', 'links', 'flips,borders,links'];
/** The level of a mesh that the picture shows, and what it is without: a column each. */
const kDrawnLevel = { 'flat sheet': 2, skirt: 3 };
const kDrawn = ['', 'borders', 'flips,borders,links'];

/** {positions: [[x, y, z]], triangles: [[a, b, c]]} */
function readLevel(folder, level) {
  const file = join(folder, `frame_${String(level).padStart(6, '0')}.obj`);
  const lines = readFileSync(file, 'utf8')
    .split('\n')
    .map((line) => line.split(' '));
  const of = (kind, take) =>
    lines.filter(([word]) => word === kind).map(([, ...words]) => words.map(take));
  return {
    positions: of('v', Number),
    triangles: of('f', (word) => Number.parseInt(word, 10) - 1),
  };
}

const named = (without) =>
  without === '' ? 'all guards' : `without ${without.replaceAll(',', ', ')}`;

/** The levels that a hierarchy has, told by the command; a panel of the picture where it is drawn. */
function studied(mesh, without, folder) {
  tell(`${mesh}, ${named(without)}`);
  const out = join(folder, `${mesh} ${without}`);
  const scene = join(root, 'assets', 'scenes', kMeshes[mesh]);
  const words = without === '' ? [] : ['--without', without];
  const { levels } = ask('hierarchy', scene, '--json', '--out', out, ...words);
  const rows = levels.map((row, level) => ({ mesh, without, level, ...row, commit }));
  if (!(mesh in kDrawnLevel && kDrawn.includes(without))) return { rows, panels: [] };
  const drawn = levels[kDrawnLevel[mesh]];
  const panel = {
    title: `${mesh}, level ${kDrawnLevel[mesh]}, ${named(without)}`,
    finest: readLevel(out, 0),
    level: readLevel(out, kDrawnLevel[mesh]),
    note: `${drawn.turned_triangles} turned, ${drawn.strayed_borders} border edges astray, ${short(100 * drawn.covered_share)} % covered`,
  };
  return { rows, panels: [panel] };
}

export function guards() {
  const folder = mkdtempSync(join(tmpdir(), 'pleat-guards-'));
  const rows = [];
  const panels = [];
  try {
    for (const mesh of Object.keys(kMeshes))
      for (const without of kWithout) {
        const found = studied(mesh, without, folder);
        rows.push(...found.rows);
        panels.push(...found.panels);
      }
  } finally {
    rmSync(folder, { recursive: true });
  }
  writeFileSync(join(root, kFigureFile), guardsFigure(panels, kDrawn.length));
  const faults = ({ turned_triangles, strayed_borders, crowded_edges }) =>
    turned_triangles + strayed_borders + crowded_edges;
  const lines = rows
    .filter(({ level }) => level > 0)
    .map((row) => [
      row.mesh,
      named(row.without),
      row.level,
      row.n_vertices,
      row.turned_triangles,
      row.strayed_borders,
      row.crowded_edges,
      (100 * row.covered_share).toFixed(1),
    ]);
  const head = ['mesh', 'guards', 'level', 'vertices', 'turned', 'strayed', 'crowded', 'covered %'];
  const guarded = rows.filter(({ without }) => without === '');
  const most = Math.max(...guarded.map(faults));
  return {
    rows,
    goals: [goal('multigrid.guarded_hierarchy_faults', most, 'at-most', 0)],
    text: `${kFigureFile}\n\n${markdown(head, lines)}`,
  };
}
