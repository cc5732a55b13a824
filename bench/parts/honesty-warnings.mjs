// Runs that show finite nonsense are told, and shipped scenes are not.
import { readdirSync } from 'node:fs';
import { join } from 'node:path';

import { asset, changed, readJson, root, shippedScene } from './assets.mjs';
import { tell } from './bench-options.mjs';
import { atLeast, atMost, hasFinished, short, table } from './bench-rows.mjs';
import { ran } from './command.mjs';

const kExplosions = join(root, 'native-tests', 'support', 'explosions.json');
const kShippedSeconds = 2; // a figure has walked in by then

/** Metrics of a run of the scene and the command's exit status with --check. */
function rowOf(name, scene, seconds, changes = {}) {
  tell(`${name}, ${JSON.stringify(changes)}`);
  const words = ['run', changed(scene, changes), '--duration', seconds, '--json', '--check'];
  const { stdout, status: exit } = ran(words, 'ignore');
  const { status, message, warnings, n_vertices, largest_stretch } = JSON.parse(stdout);
  return {
    scene: name,
    changes,
    seconds,
    exit,
    status,
    message,
    warnings,
    n_vertices,
    largest_stretch,
  };
}

function shippedRow(name) {
  const scene = shippedScene(name);
  return rowOf(`${name}.json`, scene, Math.min(scene.duration_s, kShippedSeconds));
}

/** Silent: its status says nothing. Told: by a warning, and by the exit status with --check. */
export const isTold = (row) => hasFinished(row) && row.warnings.length > 0 && row.exit === 1;

export async function warnings() {
  const explosions = readJson(kExplosions).map(({ scene, changes, seconds }) =>
    rowOf(scene, shippedScene(scene), seconds, changes),
  );
  const shipped = readdirSync(asset('scenes'), { recursive: true })
    .filter((name) => name.endsWith('.json'))
    .sort()
    .map((name) => shippedRow(name.slice(0, -'.json'.length)));
  const rows = [...explosions, ...shipped];
  const changesOf = ({ changes }) =>
    Object.entries(changes).map(([at, to]) => `${at} ${JSON.stringify(to)}`);
  const toldOf = (row) => row.warnings.map(({ kind, time_s }) => `${kind} at ${short(time_s)} s`);
  const columns = {
    scene: 'scene',
    changes: (row) => changesOf(row).join(', '),
    s: 'seconds',
    status: 'status',
    'largest stretch %': (row) => 100 * row.largest_stretch,
    told: (row) => toldOf(row).join(', ') || '-',
  };
  const nTold = explosions.filter(isTold).length;
  const nWarned = shipped.filter((row) => row.warnings.length > 0).length;
  return {
    rows,
    goals: [
      atLeast('explosions_told', nTold, 20, explosions),
      atMost('shipped_scenes_warned', nWarned, 0, shipped),
    ],
    text: `explosions that end as if all were well, and shipped scenes\n\n${table(rows, columns)}`,
  };
}
