// Holds of a deformed cloth: pins and handles, and where each has its vertices.

import type { Triple } from '../../shared/bindings/geometry';
import { minus, placeOf } from '../../shared/state/vectors';
import type { ClothAnswer } from '../bindings/deform-module';
import type { NamedHold } from './deform-state';

export interface Hold extends NamedHold {
  kind: 'pin' | 'handle';
  /** The vertex that a hand took; null for one of the experiment's own. */
  vertex: number | null;
  /** Places of its vertices before it is moved, three numbers each [m]. */
  base: readonly number[];
  /** How far it has been moved [m]. */
  offset: Triple;
}

/** A cloth as far as holding it goes. */
export type HeldCloth = Pick<ClothAnswer, 'rest_m' | 'grasp_m'>;

/** Middle of where a hold has its vertices [m]. */
export function middleOf({ base, offset }: Hold): Triple {
  const sum: Triple = [0, 0, 0];
  base.forEach((value, index) => {
    sum[index % 3] = (sum[index % 3] ?? 0) + value;
  });
  const n = base.length / 3;
  return [sum[0] / n + offset[0], sum[1] / n + offset[1], sum[2] / n + offset[2]];
}

/** Place of a hold's vertex before it is moved [m]; null if it has not that one. */
export function baseOf(hold: Hold, vertex: number): Triple | null {
  const index = hold.vertices.indexOf(vertex);
  return index < 0 ? null : placeOf(hold.base, index);
}

/** A hold of what rests within a grasp of a vertex and is not held yet; null if nothing is left. */
export function holdAt(
  cloth: HeldCloth,
  vertex: number,
  kind: Hold['kind'],
  others: readonly Hold[],
): Hold | null {
  const taken = new Set(others.flatMap((hold) => hold.vertices));
  const middle = placeOf(cloth.rest_m, vertex);
  const vertices: number[] = [];
  for (let v = 0; 3 * v < cloth.rest_m.length; ++v) {
    const isNear = Math.hypot(...minus(placeOf(cloth.rest_m, v), middle)) <= cloth.grasp_m;
    if (isNear && !taken.has(v)) vertices.push(v);
  }
  if (!vertices.includes(vertex)) return null;
  const base = vertices.flatMap((v) => placeOf(cloth.rest_m, v));
  return { name: `point ${vertex}`, kind, vertex, vertices, base, offset: [0, 0, 0] };
}

/** Vertices that hang together by edges, part by part. */
function connectedParts(vertices: readonly number[], triangles: Uint32Array): number[][] {
  const parts = new Map(vertices.map((vertex) => [vertex, [vertex]]));
  for (let corner = 0; corner < triangles.length; ++corner) {
    const a = parts.get(triangles[corner] ?? -1);
    const b = parts.get(triangles[corner % 3 === 2 ? corner - 2 : corner + 1] ?? -1);
    if (!a || !b || a === b) continue;
    a.push(...b);
    for (const vertex of b) parts.set(vertex, a);
  }
  return [...new Set(parts.values())].map((part) => part.sort((a, b) => a - b));
}

/** The holds of an experiment before a visitor changes them. */
export function holdsOf(answer: ClothAnswer, triangles: Uint32Array): Hold[] {
  const named = new Map(
    answer.groups.map(({ name, vertices }) => [vertices.join(), name.replaceAll('_', ' ')]),
  );
  const pins = connectedParts(answer.pins, triangles).map((vertices, index): Hold => {
    const name = named.get(vertices.join()) ?? `pin ${index + 1}`;
    const base = vertices.flatMap((vertex) => placeOf(answer.rest_m, vertex));
    return { name, kind: 'pin', vertex: null, vertices, base, offset: [0, 0, 0] };
  });
  const handles = answer.handles.map(
    ({ name, vertices, places_m }): Hold => ({
      name,
      kind: 'handle',
      vertex: null,
      vertices,
      base: places_m,
      offset: [0, 0, 0],
    }),
  );
  return [...pins, ...handles];
}

/** All held vertices, ascending, and their places. */
export function joined(holds: readonly Hold[]): { vertices: Int32Array; places: Float64Array } {
  const places = new Map<number, Triple>();
  for (const { vertices, base, offset } of holds) {
    vertices.forEach((vertex, index) => {
      const [x, y, z] = placeOf(base, index);
      if (!places.has(vertex)) places.set(vertex, [x + offset[0], y + offset[1], z + offset[2]]);
    });
  }
  const vertices = Int32Array.from(places.keys()).sort();
  return {
    vertices,
    places: Float64Array.from([...vertices].flatMap((vertex) => places.get(vertex) ?? [])),
  };
}
