// Hierarchies without the guards of their collapses: faults of each level, and a picture of right
// beside wrong.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { asset, root } from './assets.mjs';
import { tell } from './bench-options.mjs';
import { atMost, short, table } from './bench-rows.mjs';
import { guardsFigure } from './charts.mjs';
import { ask, commit, inFolder } from './command.mjs';

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
  const text = readFileSync(file, 'utf8');
  const lines = text.split('\n').map((line) => line.split(' '));
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
  const words = without === '' ? [] : ['--without', without];
  const scene = asset('scenes', kMeshes[mesh]);
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
  const found = inFolder((folder) =>
    Object.keys(kMeshes).flatMap((mesh) =>
      kWithout.map((without) => studied(mesh, without, folder)),
    ),
  );
  const panels = found.flatMap((one) => one.panels);
  writeFileSync(join(root, kFigureFile), guardsFigure(panels, kDrawn.length));
  const rows = found.flatMap((one) => one.rows);
  const faults = ({ turned_triangles, strayed_borders, crowded_edges }) =>
    turned_triangles + strayed_borders + crowded_edges;
  const columns = {
    mesh: 'mesh',
    guards: (row) => named(row.without),
    level: 'level',
    vertices: 'n_vertices',
    turned: 'turned_triangles',
    strayed: 'strayed_borders',
    crowded: 'crowded_edges',
    'covered %': (row) => (100 * row.covered_share).toFixed(1),
  };
  const coarser = rows.filter(({ level }) => level > 0);
  const most = Math.max(...rows.filter(({ without }) => without === '').map(faults));
  return {
    rows,
    goals: [atMost('guarded_hierarchy_faults', most, 0)],
    text: `${kFigureFile}\n\n${table(coarser, columns)}`,
  };
}
