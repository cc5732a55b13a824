// How far a shape stretches cloth and pushes it together, and how far from rest towards it a motion can start.
import type { Triple } from '../../shared/bindings/geometry';
import { percent } from '../../shared/panels/quantity';
import { dot, minus } from '../../shared/state/vectors';

/** Edges of a mesh, two vertices each, and their lengths at rest [m]. */
export interface RestEdges {
  ends: Uint32Array;
  lengths: Float64Array;
  rest: ArrayLike<number>;
}

/** Longest and shortest edge, over what they are at rest. */
export interface EdgeReach {
  longest: number;
  shortest: number;
  /** Part of the straight way from rest to the shape on which all edges stay within what cloth bears. */
  share: number;
}

/** Length of woven cloth over that at rest that it bears; the hand of cloth in motion gives it no more. */
export const BORNE = 1.1;

/** Cloth gives way by folds: edges pushed together further than this would spring apart. */
export const BORNE_SHORT = 1 / BORNE;

function edgeOf(places: ArrayLike<number>, a: number, b: number): Triple {
  const along = (axis: number) => (places[3 * a + axis] ?? 0) - (places[3 * b + axis] ?? 0);
  return [along(0), along(1), along(2)];
}

/** Edges that two triangles share come twice. */
export function restEdges(triangles: Uint32Array, rest: ArrayLike<number>): RestEdges {
  const ends = new Uint32Array(2 * triangles.length);
  const lengths = new Float64Array(triangles.length);
  for (let corner = 0; corner < triangles.length; ++corner) {
    const a = triangles[corner] ?? 0;
    const b = triangles[corner % 3 === 2 ? corner - 2 : corner + 1] ?? 0;
    ends.set([a, b], 2 * corner);
    lengths[corner] = Math.hypot(...edgeOf(rest, a, b));
  }
  return { ends, lengths, rest };
}

/**
 * Part s of the way of an edge from `rest` to `end` before it leaves what cloth bears; at most 1. Its length squared,
 * |rest + s (end - rest)|^2 = L^2 + 2 p s + q s^2, meets the upper bound once, and the lower one at the smaller root,
 * or nowhere.
 */
function shareOf(rest: Triple, end: Triple): number {
  const move = minus(end, rest);
  const [L2, p, q] = [dot(rest, rest), dot(rest, move), dot(move, move)];
  if (q === 0) return 1;
  const longer = (Math.sqrt(p * p + q * (BORNE ** 2 - 1) * L2) - p) / q;
  const inner = p * p - q * (1 - BORNE_SHORT ** 2) * L2;
  const shorter = p < 0 && inner >= 0 ? (-p - Math.sqrt(inner)) / q : 1;
  return Math.min(longer, shorter, 1);
}

export function reachOf({ ends, lengths, rest }: RestEdges, places: ArrayLike<number>): EdgeReach {
  let longest = 0;
  let shortest = Number.POSITIVE_INFINITY;
  let share = 1;
  lengths.forEach((length, edge) => {
    const [a, b] = [ends[2 * edge] ?? 0, ends[2 * edge + 1] ?? 0];
    const end = edgeOf(places, a, b);
    const ratio = Math.hypot(...end) / length;
    longest = Math.max(longest, ratio);
    shortest = Math.min(shortest, ratio);
    share = Math.min(share, shareOf(edgeOf(rest, a, b), end));
  });
  return { longest, shortest, share };
}

/** The shape that part of the straight way from rest. */
export function easedShape(
  rest: ArrayLike<number>,
  places: Float64Array,
  share: number,
): Float64Array {
  return places.map((place, k) => (1 - share) * (rest[k] ?? 0) + share * place);
}

/** Two digits; more where they would read as the bound. */
function times(ratio: number): string {
  return Number(ratio.toPrecision(2)) > BORNE ? ratio.toPrecision(2) : ratio.toPrecision(4);
}

/** "eased in by 12 %"; empty for a shape that a motion starts from as it is. */
export function easedWords({ share }: Pick<EdgeReach, 'share'>): string {
  return share < 1 ? `eased in by ${percent(share)}` : '';
}

/** The sentence why a motion starts from a part of the way to such a shape; null where it starts from all of it. */
export function easedSentence({ longest, shortest, share }: EdgeReach): string | null {
  if (share === 1) return null;
  const part = `It starts ${easedWords({ share })} of the way from rest to this shape`;
  if (longest > BORNE)
    return `${part}, which is stretched to ${times(longest)} times somewhere: woven cloth bears about ${BORNE}.`;
  if (shortest < BORNE_SHORT)
    return `${part}, which is pushed together to ${shortest.toPrecision(2)} of its length somewhere, where cloth would fold.`;
  return `${part}: farther on, some of it would be shorter on its way than cloth without folds.`;
}
