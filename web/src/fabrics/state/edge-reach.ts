// How far a shape stretches cloth and pushes it together: whether a motion can start from it.

/** Edges of a mesh, two vertices each, and their lengths at rest [m]. */
export interface RestEdges {
  ends: Uint32Array;
  lengths: Float64Array;
}

/** Longest and shortest edge, over what they are at rest. */
export interface EdgeReach {
  longest: number;
  shortest: number;
}

/** Length of woven cloth over that at rest that it bears; the hand of cloth in motion gives it no more. */
export const BORNE = 1.1;

/** Cloth gives way by folds: edges pushed together further than this would spring apart. */
export const BORNE_SHORT = 1 / BORNE;

function lengthOf(places: ArrayLike<number>, a: number, b: number): number {
  const along = (axis: number) => (places[3 * a + axis] ?? 0) - (places[3 * b + axis] ?? 0);
  return Math.hypot(along(0), along(1), along(2));
}

/** Edges that two triangles share come twice. */
export function restEdges(triangles: Uint32Array, rest: ArrayLike<number>): RestEdges {
  const ends = new Uint32Array(2 * triangles.length);
  const lengths = new Float64Array(triangles.length);
  for (let corner = 0; corner < triangles.length; ++corner) {
    const a = triangles[corner] ?? 0;
    const b = triangles[corner % 3 === 2 ? corner - 2 : corner + 1] ?? 0;
    ends.set([a, b], 2 * corner);
    lengths[corner] = lengthOf(rest, a, b);
  }
  return { ends, lengths };
}

export function reachOf({ ends, lengths }: RestEdges, places: ArrayLike<number>): EdgeReach {
  let longest = 0;
  let shortest = Number.POSITIVE_INFINITY;
  lengths.forEach((length, edge) => {
    const ratio = lengthOf(places, ends[2 * edge] ?? 0, ends[2 * edge + 1] ?? 0) / length;
    longest = Math.max(longest, ratio);
    shortest = Math.min(shortest, ratio);
  });
  return { longest, shortest };
}

/** Two digits; more where they would read as the bound. */
function times(ratio: number): string {
  return Number(ratio.toPrecision(2)) > BORNE ? ratio.toPrecision(2) : ratio.toPrecision(4);
}

/** The sentence why no motion starts from such a shape; null where one does. */
export function startRefusal({ longest, shortest }: EdgeReach): string | null {
  if (longest > BORNE)
    return `Stretched to ${times(longest)} times somewhere; a run starts from at most ${BORNE} times, about what woven cloth bears. Pull it less far to let it go.`;
  if (shortest < BORNE_SHORT)
    return `Pushed together to ${shortest.toPrecision(2)} of its length somewhere, where cloth would fold. Push it less far to let it go.`;
  return null;
}
