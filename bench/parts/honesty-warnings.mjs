// Runs that show finite nonsense are told, and shipped scenes are not.
import { spawnSync } from 'node:child_process';
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';

import { tell } from './bench-parts.mjs';
import { goal, hasFinished, markdown, short } from './bench-rows.mjs';
import { command, root, withFiles } from './command.mjs';

const kScenes = join(root, 'assets', 'scenes');
const kExplosions = join(root, 'native-tests', 'support', 'explosions.json');
const kShippedSeconds = 2; // a figure has walked in by then

/** The scene with values at JSON pointers; objects that are missing on the way are made. */
export function changed(scene, changes) {
  const result = structuredClone(scene);
  for (const [pointer, value] of Object.entries(changes)) {
    const keys = pointer.slice(1).split('/');
    const last = keys.pop();
    let place = result;
    for (const key of keys) place = place[key] ??= {};
    place[last] = value;
  }
  return result;
}

/** The scene with the names of its files as they are from anywhere. */
function withFullNames(scene, folder) {
  const { mesh } = scene.cloth;
  const { figure } = scene;
  const full = structuredClone(scene);
  if (mesh?.obj) full.cloth.mesh.obj = join(folder, mesh.obj);
  if (typeof figure?.motion === 'string') full.figure.motion = join(folder, figure.motion);
  if (typeof scene.start === 'string') full.start = join(folder, scene.start);
  return full;
}

/** The command's word on a run of the scene with --check: its metrics and its exit status. */
function checkedRun(scene, seconds) {
  return withFiles(['run', scene, '--duration', seconds, '--json', '--check'], (words) => {
    const { status, stdout } = spawnSync(command, words, {
      encoding: 'utf8',
      stdio: ['ignore', 'pipe', 'ignore'],
      maxBuffer: 2 ** 26,
    });
    return { metrics: JSON.parse(stdout), exit: status };
  });
}

function rowOf({ name, changes = {}, seconds, scene }) {
  tell(`${name}, ${JSON.stringify(changes)}`);
  const { metrics, exit } = checkedRun(scene, seconds);
  const { status, message, warnings, n_vertices, largest_stretch } = metrics;
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

function explosionRow({ scene: name, changes, seconds }) {
  const file = join(kScenes, `${name}.json`);
  const scene = withFullNames(JSON.parse(readFileSync(file, 'utf8')), dirname(file));
  return rowOf({ name, changes, seconds, scene: changed(scene, changes) });
}

function shippedRow(path) {
  const scene = withFullNames(JSON.parse(readFileSync(path, 'utf8')), dirname(path));
  const seconds = Math.min(scene.duration_s, kShippedSeconds);
  return rowOf({ name: relative(kScenes, path), seconds, scene });
}

/** Silent: its status says nothing. Told: by a warning, and by the exit status with --check. */
export const isTold = (row) => hasFinished(row) && row.warnings.length > 0 && row.exit === 1;

function lineOf(row) {
  const { scene, changes, seconds, status, largest_stretch, warnings } = row;
  const told = warnings.map(({ kind, time_s }) => `${kind} at ${short(time_s)} s`);
  return [
    scene,
    Object.entries(changes)
      .map(([pointer, value]) => `${pointer} ${JSON.stringify(value)}`)
      .join(', '),
    short(seconds),
    status,
    short(100 * largest_stretch),
    told.join(', ') || '-',
  ];
}

export async function warnings() {
  const explosions = JSON.parse(readFileSync(kExplosions, 'utf8')).map(explosionRow);
  const paths = readdirSync(kScenes, { recursive: true, encoding: 'utf8' })
    .filter((name) => name.endsWith('.json'))
    .sort()
    .map((name) => join(kScenes, name));
  const shipped = paths.map(shippedRow);
  const head = ['scene', 'changes', 's', 'status', 'largest stretch %', 'told'];
  const nTold = explosions.filter(isTold).length;
  const nWarned = shipped.filter((row) => row.warnings.length > 0).length;
  return {
    rows: [...explosions, ...shipped],
    goals: [
      goal('truth.explosions_told', nTold, 'at-least', 20, explosions),
      goal('truth.shipped_scenes_warned', nWarned, 'at-most', 0, shipped),
    ],
    text: `explosions that end as if all were well, and shipped scenes\n\n${markdown(head, [...explosions, ...shipped].map(lineOf))}`,
  };
}
