// Distances of a mesh's faces from the fine cloth, at the same points of it. A face is the bilinear patch of
// its corners, and the fine mesh's vertices on it are where it is looked at.
import { countFaces, faceAt } from './plan-file';

/** The parts of a mesh that tell how it was refined. */
export interface RefinedMesh {
  faces: Int32Array;
  /** Four a vertex, -1 for none. */
  parents: Int32Array;
}

const PARENTS_PER_VERTEX = 4;

/** A vertex by those that it is the middle of. */
function keyOf(vertices: readonly number[]): string {
  return [...vertices].sort((a, b) => a - b).join();
}

function parentsAt(parents: Int32Array, vertex: number): number[] {
  const at = PARENTS_PER_VERTEX * vertex;
  return [...parents.subarray(at, at + PARENTS_PER_VERTEX)].filter((parent) => parent >= 0);
}

/** Vertices of the fine mesh, by the key of their parents. */
function middlesOf({ parents }: RefinedMesh): Map<string, number> {
  const middles = new Map<string, number>();
  for (let vertex = 0; vertex < parents.length / PARENTS_PER_VERTEX; ++vertex) {
    const own = parentsAt(parents, vertex);
    if (own.length > 0) middles.set(keyOf(own), vertex);
  }
  return middles;
}

function countBase({ parents }: RefinedMesh): number {
  const nVertices = parents.length / PARENTS_PER_VERTEX;
  let nBase = 0;
  while (nBase < nVertices && parents[PARENTS_PER_VERTEX * nBase] === -1) nBase += 1;
  return nBase;
}

/** The fine vertex at each vertex of the mesh; null where the fine mesh does not refine it. */
function fineVertices(mesh: RefinedMesh, fine: RefinedMesh, middles: Map<string, number>) {
  if (countBase(mesh) !== countBase(fine)) return null;
  const found: number[] = [];
  for (let vertex = 0; vertex < mesh.parents.length / PARENTS_PER_VERTEX; ++vertex) {
    const own = parentsAt(mesh.parents, vertex);
    const key = own.length > 0 ? keyOf(own.map((parent) => found[parent] ?? -1)) : '';
    const at = own.length > 0 ? middles.get(key) : vertex;
    if (at === undefined) return null;
    found.push(at);
  }
  return found;
}

/** A fine vertex on a face, and the weights of the face's corners there and of the point in the mean. */
interface Point {
  vertex: number;
  corners: [number, number, number, number];
  weight: number;
}

/** Part of a face: its corners in the fine mesh, and where they lie on the face, from 0 to 1. */
interface Patch {
  corners: readonly number[];
  places: readonly (readonly [number, number])[];
}

/** The four quarters of a part; null where the fine mesh does not split it. */
function quartersOf({ corners, places }: Patch, middles: Map<string, number>): Patch[] | null {
  const next = (k: number) => (k + 1) % 4;
  const centre = middles.get(keyOf(corners));
  const sides = corners.map((corner, k) =>
    middles.get(keyOf([corner, corners[next(k)] ?? corner])),
  );
  if (centre === undefined || sides.includes(undefined)) return null;
  const between = (a: number, b: number): [number, number] => {
    const [u, v] = places[a] ?? [0, 0];
    const [p, q] = places[b] ?? [0, 0];
    return [(u + p) / 2, (v + q) / 2];
  };
  return [0, 1, 2, 3].map((k) => ({
    corners: [corners[k], sides[k], centre, sides[(k + 3) % 4]] as number[],
    places: [places[k] ?? [0, 0], between(k, next(k)), between(0, 2), between((k + 3) % 4, k)],
  }));
}

/** The fine vertices on a face, each as often as fine faces have it: the trapezoid rule. */
function pointsOf(patch: Patch, middles: Map<string, number>): Point[] {
  const quarters = quartersOf(patch, middles);
  if (quarters) {
    const all = quarters.flatMap((quarter) => pointsOf(quarter, middles));
    return all.map((point) => ({ ...point, weight: point.weight / 4 }));
  }
  return patch.corners.map((vertex, k) => {
    const [u, v] = patch.places[k] ?? [0, 0];
    const corners: Point['corners'] = [(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v];
    return { vertex, corners, weight: 1 / 4 };
  });
}

/** Each vertex once. */
function merged(points: readonly Point[]): Point[] {
  const once = new Map<number, Point>();
  for (const point of points) {
    const weight = (once.get(point.vertex)?.weight ?? 0) + point.weight;
    once.set(point.vertex, { ...point, weight });
  }
  return [...once.values()];
}

const WHOLE = [
  [0, 0],
  [1, 0],
  [1, 1],
  [0, 1],
] as const;

/** Square of the distance of a face from the fine cloth at a point. */
function squareAt(point: Point, corners: readonly number[], own: Float32Array, fine: Float32Array) {
  let square = 0;
  for (let axis = 0; axis < 3; ++axis) {
    let at = 0;
    for (let k = 0; k < 4; ++k)
      at += (point.corners[k] ?? 0) * (own[3 * (corners[k] ?? 0) + axis] ?? Number.NaN);
    square += (at - (fine[3 * point.vertex + axis] ?? Number.NaN)) ** 2;
  }
  return square;
}

/** Root mean square of each face's distance from the fine cloth [m], from the places of both. */
export type FaceDistances = (own: Float32Array, fine: Float32Array) => Float32Array;

/** Null where the fine mesh does not refine the other one. */
export function createFaceDistances(mesh: RefinedMesh, fine: RefinedMesh): FaceDistances | null {
  const middles = middlesOf(fine);
  const found = fineVertices(mesh, fine, middles);
  if (!found) return null;
  const faces = Array.from({ length: countFaces(mesh.faces) }, (_, index) => {
    const { corners } = faceAt(mesh.faces, index);
    const patch = { corners: corners.map((corner) => found[corner] ?? -1), places: WHOLE };
    return { corners, points: merged(pointsOf(patch, middles)) };
  });
  return (own, places) =>
    Float32Array.from(faces, ({ corners, points }) =>
      Math.sqrt(
        points.reduce(
          (sum, point) => sum + point.weight * squareAt(point, corners, own, places),
          0,
        ),
      ),
    );
}
