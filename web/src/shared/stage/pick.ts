// Finds the point of the cloth that a ray meets first.
import type { Triple } from '../bindings/geometry';
import { cross, dot, minus, placeOf } from '../state/vectors';

export interface Hit {
  /** Distance along the ray, in lengths of its direction. */
  distance: number;
  point: Triple;
  /** Index in the list. */
  triangle: number;
  /** The corner of the met triangle that is nearest to the point. */
  vertex: number;
}

/**
 * Distance along the ray to a triangle from either side, or null.
 * Source: Möller and Trumbore, Fast, minimum storage ray-triangle intersection, JGT 2(1), 1997.
 */
function meets(
  origin: Triple,
  direction: Triple,
  x0: Triple,
  x1: Triple,
  x2: Triple,
): number | null {
  const edge1 = minus(x1, x0);
  const edge2 = minus(x2, x0);
  const p = cross(direction, edge2);
  const determinant = dot(edge1, p);
  if (determinant === 0) return null; // the ray lies in the plane, or the triangle has no area
  const t = minus(origin, x0);
  const u = dot(t, p) / determinant;
  const q = cross(t, edge1);
  const v = dot(direction, q) / determinant;
  if (u < 0 || v < 0 || u + v > 1) return null;
  const distance = dot(edge2, q) / determinant;
  return distance > 0 ? distance : null;
}

/** The first triangle that the ray meets, from either side; null when it meets none. */
export function pick(
  positions: Float32Array,
  triangles: Uint32Array,
  origin: Triple,
  direction: Triple,
): Hit | null {
  let nearest = Number.POSITIVE_INFINITY;
  let corners: Triple | null = null;
  let triangle = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [triangles[t] ?? 0, triangles[t + 1] ?? 0, triangles[t + 2] ?? 0];
    const distance = meets(
      origin,
      direction,
      placeOf(positions, a),
      placeOf(positions, b),
      placeOf(positions, c),
    );
    if (distance !== null && distance < nearest) {
      nearest = distance;
      corners = [a, b, c];
      triangle = t / 3;
    }
  }
  if (!corners) return null;
  const point: Triple = [
    origin[0] + nearest * direction[0],
    origin[1] + nearest * direction[1],
    origin[2] + nearest * direction[2],
  ];
  const away = corners.map((vertex) => {
    const offset = minus(placeOf(positions, vertex), point);
    return dot(offset, offset);
  });
  const vertex = corners[away.indexOf(Math.min(...away))] ?? corners[0];
  return { distance: nearest, point, triangle, vertex };
}

/** A picture: `matrix` takes places to clip space, column by column; the size in pixels. */
export interface Picture {
  matrix: ArrayLike<number>;
  width: number;
  height: number;
}

/**
 * The vertex that is seen nearest to a point of the picture, in pixels from its upper left corner;
 * null when none is within `reach`.
 */
export function nearestSeen(
  positions: Float32Array,
  { matrix, width, height }: Picture,
  point: { x: number; y: number },
  reach: number,
): number | null {
  const row = (index: number, [x, y, z]: Triple) =>
    (matrix[index] ?? 0) * x +
    (matrix[index + 4] ?? 0) * y +
    (matrix[index + 8] ?? 0) * z +
    (matrix[index + 12] ?? 0);
  let nearest: number | null = null;
  let least = reach;
  for (let vertex = 0; 3 * vertex < positions.length; ++vertex) {
    const place = placeOf(positions, vertex);
    const w = row(3, place);
    if (w <= 0) continue; // the vertex is behind the eye
    const across = ((row(0, place) / w + 1) / 2) * width - point.x;
    const down = ((1 - row(1, place) / w) / 2) * height - point.y;
    const away = Math.hypot(across, down);
    if (away > least) continue;
    least = away;
    nearest = vertex;
  }
  return nearest;
}
