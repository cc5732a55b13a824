// The vertex of a cloth that asks to be taken.
import { Vector3 } from 'three';

/** A metre lower counts as much as two metres nearer: free corners hang low. */
const LOW_OVER_NEAR = 2;

/** The vertices on the border: those of edges that only one triangle has. */
function borderOf(triangles: Uint32Array, nVertices: number): Set<number> {
  const single = new Map<number, [number, number]>();
  for (let corner = 0; corner < triangles.length; ++corner) {
    const a = triangles[corner] ?? 0;
    const b = triangles[corner % 3 === 2 ? corner - 2 : corner + 1] ?? 0;
    const key = Math.min(a, b) * nVertices + Math.max(a, b);
    if (!single.delete(key)) single.set(key, [a, b]);
  }
  return new Set([...single.values()].flat());
}

/** Low, on the side of the eye, and inside the border, so that there is cloth all around it. */
export function invitingVertex(
  positions: Float32Array,
  triangles: Uint32Array,
  towards: Vector3,
): number {
  const nVertices = positions.length / 3;
  const border = borderOf(triangles, nVertices);
  const isAllBorder = border.size === nVertices;
  let best = 0;
  let bestScore = Number.NEGATIVE_INFINITY;
  const place = new Vector3();
  for (let v = 0; v < nVertices; ++v) {
    if (!isAllBorder && border.has(v)) continue;
    place.fromArray(positions, 3 * v);
    const score = place.dot(towards) - LOW_OVER_NEAR * place.y;
    if (score > bestScore) {
      bestScore = score;
      best = v;
    }
  }
  return best;
}
