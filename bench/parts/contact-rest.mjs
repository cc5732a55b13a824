// Layers that come to rest on each other: what is left of their motion after 5 s, how far they creep
// in the next 10 s, and whether those on a ball keep their order.
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';

import { BadInput, tell } from './bench-options.mjs';
import { atMost, largest, table } from './bench-rows.mjs';
import { commit, inFolder, ran } from './command.mjs';
import { kNeedThreads, kTakeMeshes, withContact } from './contact-scenes.mjs';
import { tenFolds, tenLayers, threeFolds, threeSheets } from './contact-stacks.mjs';

const kSettled = 5; // s
const kLater = 15; // s
const kMostEnergy = 1e-6; // J, kinetic
const kMostDrift = 0.1; // mm

const kStacks = {
  ten_layers: { sheets: () => tenLayers(8), strip: () => tenFolds(5) },
  three_sheets: { sheets: () => threeSheets(12), strip: () => threeFolds(6) },
};

/** Metrics after so long, and places as triples: none of a run that ended before. */
const endOf = (scene, duration_s) =>
  inFolder((folder) => {
    const state = join(folder, 'state.json');
    const { stdout } = ran(['run', { ...scene, duration_s }, '--json', '--state', state], 'pipe');
    const places = existsSync(state) ? JSON.parse(readFileSync(state, 'utf8')).positions_m : [];
    return { metrics: JSON.parse(stdout), places };
  });

const cross = ([a, b, c], [x, y, z]) => [b * z - c * y, c * x - a * z, a * y - b * x];
const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);
const minus = (a, b) => a.map((x, k) => x - b[k]);

/** How far along a direction from the origin a triangle is met, in its length; NaN: it is not. */
export function heightOf([a, b, c], direction) {
  const [u, v] = [minus(b, a), minus(c, a)];
  const normal = cross(u, v);
  const height = dot(normal, a) / dot(normal, direction);
  const inside = [
    [a, b],
    [b, c],
    [c, a],
  ].every(([p, q]) => {
    const met = direction.map((x) => x * height);
    return dot(cross(minus(q, p), minus(met, p)), normal) >= 0;
  });
  return inside && height > 0 ? height : Number.NaN;
}

/**
 * Vertices of sheets that are below the sheet under them, seen along the normals of a ball about
 * the origin.
 *
 * n: vertices of each sheet, which follow each other from the lowest
 */
export function outOfOrder(places, triangles, n) {
  const faces = triangles.map((triangle) => triangle.map((v) => places[v]));
  return places.filter((place, v) => {
    const below = Math.floor(v / n) - 1;
    return faces.some(
      (face, f) => Math.floor(triangles[f][0] / n) === below && heightOf(face, place) > 1,
    );
  }).length;
}

function rowOf(name, make, stepper) {
  const scene = withContact(make(), { stepper }, true);
  tell(`${scene.name}, ${stepper}`);
  const about = { case: name, scene: scene.name, stepper, commit };
  try {
    const settled = endOf(scene, kSettled);
    const later = endOf(scene, kLater);
    const ways = later.places.map((place, v) => Math.hypot(...minus(place, settled.places[v])));
    const { mesh } = scene.cloth;
    const isOnBall = mesh && name === 'three_sheets';
    return {
      ...about,
      status: later.metrics.status,
      method: later.metrics.method,
      n_faces: later.metrics.n_triangles,
      cloth_contact: later.metrics.cloth_contact,
      rest_energy_j: settled.metrics.energy.kinetic_j,
      rest_energy_later_j: later.metrics.energy.kinetic_j,
      drift_mm: 1e3 * largest(ways),
      crossings: later.metrics.largest_crossings,
      out_of_order: isOnBall
        ? outOfOrder(later.places, mesh.triangles, mesh.positions_m.length / 3)
        : undefined,
      told: [...new Set(later.metrics.warnings.map(({ kind }) => kind))],
      reference: { id: 'rest', description: 'cloth that lies on cloth stays where it is' },
      core: later.metrics.core,
    };
  } catch (error) {
    if (!(error instanceof BadInput)) throw error;
    return { ...about, status: 'refused', told: [error.message] };
  }
}

const kColumns = {
  scene: 'scene',
  stepper: 'stepper',
  faces: 'n_faces',
  pairs: (row) => row.cloth_contact?.n_pairs,
  'J at 5 s': 'rest_energy_j',
  'J at 15 s': 'rest_energy_later_j',
  'drift mm': 'drift_mm',
  crossings: 'crossings',
  'out of order': 'out_of_order',
  'held back %': (row) => 100 * row.cloth_contact?.held_back_share,
  status: 'status',
  told: (row) => row.told.join(', '),
};

/** Goals of the stepper that does worst. */
export function restGoals(rows) {
  const goals = Object.keys(kStacks).flatMap((name) => {
    const its = rows.filter((row) => row.case === name);
    const worst = (key) => largest(its.map((row) => row[key]));
    return [
      atMost(`rest_energy_${name}_J`, worst('rest_energy_j'), kMostEnergy, its),
      atMost(`drift_${name}_mm`, worst('drift_mm'), kMostDrift, its),
    ];
  });
  const sheets = rows.filter((row) => row.out_of_order !== undefined);
  const sum = rows.reduce((all, { crossings }) => all + (crossings ?? Number.NaN), 0);
  return [
    ...goals,
    atMost('out_of_order_three_sheets', largest(sheets.map((row) => row.out_of_order)), 0, sheets),
    atMost('crossings_at_rest', sum, 0, rows),
  ];
}

/** Sheets of their own where a stepper takes a mesh, else one strip in as many layers. */
export async function rest() {
  const rows = Object.entries(kStacks).flatMap(([name, { sheets, strip }]) => [
    ...kTakeMeshes.map((stepper) => rowOf(name, sheets, stepper)),
    ...kNeedThreads.map((stepper) => rowOf(name, strip, stepper)),
  ]);
  const text = `kinetic energy, and the way of the farthest vertex from 5 to 15 s\n\n${table(rows, kColumns)}`;
  return { rows, goals: restGoals(rows), text };
}
