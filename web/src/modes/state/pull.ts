// A hand on a body whose shapes are mixes of modes, or on one that moves through its keys.

import type { Triple } from '../../shared/bindings/geometry';
import { cross, dot, minus, placeOf } from '../../shared/state/vectors';
import type { FilledFrame } from '../bindings/modal-module';
import type { ModeNumbers } from './material';

/** Modes that fall or hardly resist are taken for this stiff, over the first that swings. */
const LEAST_RELATIVE = 0.3;

/** Share of the largest entry that keeps directions out in which no mode goes. */
const LEAST_SHARE = 1e-3;

type Matrix = [Triple, Triple, Triple];

/** x with rows · x = wanted, by Cramer's rule. */
function solved([p, q, r]: Matrix, wanted: Triple): Triple {
  const columns = [cross(q, r), cross(r, p), cross(p, q)] as const;
  const determinant = dot(p, columns[0]);
  const at = (axis: 0 | 1 | 2) =>
    (columns[0][axis] * wanted[0] + columns[1][axis] * wanted[1] + columns[2][axis] * wanted[2]) /
    determinant;
  return [at(0), at(1), at(2)];
}

/**
 * The mix of least energy that moves a vertex by `move` [m]: with moves p_i of the vertex and stiffness l_i, a force f
 * mixes in p_i · f / l_i of each, and f is the one whose mix goes where it is wanted. Amplitudes end at 1.
 */
export function pulledMix(
  moves: Float32Array,
  modes: readonly ModeNumbers[],
  shapeLength: number,
  vertex: number,
  reach: number,
  move: Triple,
): number[] {
  const ofVertex = modes.map((_, mode): Triple => {
    const at = mode * shapeLength + 3 * vertex;
    return [0, 1, 2].map((axis) => reach * (moves[at + axis] ?? 0)) as Triple;
  });
  const softness = modes.map(({ relative }) => Math.max(relative, LEAST_RELATIVE) ** -2);
  const compliance: Matrix = [
    [0, 0, 0],
    [0, 0, 0],
    [0, 0, 0],
  ];
  ofVertex.forEach((p, mode) => {
    for (const row of [0, 1, 2] as const)
      for (const column of [0, 1, 2] as const)
        compliance[row][column] += p[row] * p[column] * (softness[mode] ?? 0);
  });
  const largest = Math.max(...[0, 1, 2].map((axis) => compliance[axis as 0][axis as 0]));
  if (!(largest > 0)) return modes.map(() => 0);
  for (const axis of [0, 1, 2] as const) compliance[axis][axis] += LEAST_SHARE * largest;
  const force = solved(compliance, move);
  return ofVertex.map((p, mode) =>
    Math.min(1, Math.max(-1, dot(p, force) * (softness[mode] ?? 0))),
  );
}

/** The time at which a vertex is nearest to a place, on its way through the frames. */
export function timeNearest(
  filled: Float32Array,
  frames: readonly FilledFrame[],
  vertex: number,
  place: Triple,
): number {
  const length = filled.length / frames.length;
  const at = (frame: number) => placeOf(filled, (frame * length) / 3 + vertex);
  let best = { time: 0, square: Number.POSITIVE_INFINITY };
  for (let frame = 0; frame + 1 < frames.length; ++frame) {
    const [from, to] = [at(frame), at(frame + 1)];
    const way = minus(to, from);
    const along = dot(minus(place, from), way) / Math.max(dot(way, way), Number.MIN_VALUE);
    const share = Math.min(1, Math.max(0, along));
    const away = minus(
      place,
      from.map((value, axis) => value + share * (way[axis] ?? 0)) as Triple,
    );
    const square = dot(away, away);
    const [begin, end] = [frames[frame]?.time ?? 0, frames[frame + 1]?.time ?? 0];
    if (square < best.square) best = { time: begin + share * (end - begin), square };
  }
  return best.time;
}
