// Shapes that modes add up to, and what a surface measures.

/** Share by which the farthest vertex moves at full amplitude of the body's extent. */
export const REACH = 0.15;

/** Writes shape + sum of amplitude · reach · move; `reach` in metres, moves one after the other. */
export function mixInto(
  target: Float32Array | Float64Array,
  shape: Float64Array,
  moves: Float32Array,
  amplitudes: readonly number[],
  reach: number,
): void {
  target.set(shape);
  amplitudes.forEach((amplitude, mode) => {
    if (amplitude === 0) return;
    const scale = amplitude * reach;
    const offset = mode * shape.length;
    if (offset + shape.length > moves.length) return;
    for (let k = 0; k < shape.length; ++k)
      target[k] = (target[k] as number) + scale * (moves[offset + k] as number);
  });
}

/** Change of a closed body's volume, as a share, that is too small to see. */
const MOST_SWELL = 0.02;

/** Largest amplitude, up to 1, at which a mode's straight swing neither swells nor shrinks a closed body. */
export function quietAmplitude(
  move: Float32Array,
  shape: Float64Array,
  triangles: Uint32Array,
  reach: number,
): number {
  const rest = enclosedVolume(shape, triangles);
  const mixed = new Float64Array(shape.length);
  const swells = (amplitude: number): boolean => {
    mixInto(mixed, shape, move, [amplitude], reach);
    return Math.abs(enclosedVolume(mixed, triangles) / rest - 1) > MOST_SWELL;
  };
  let amplitude = 1;
  while (swells(amplitude) || swells(-amplitude)) amplitude *= 0.9;
  return amplitude;
}

/** Largest distance between a vertex in one shape and in another [m]. */
export function farthestMove(a: ArrayLike<number>, b: ArrayLike<number>): number {
  let most = 0;
  for (let k = 0; k + 2 < a.length; k += 3) {
    const [x, y, z] = [0, 1, 2].map((axis) => (a[k + axis] as number) - (b[k + axis] as number));
    most = Math.max(most, Math.hypot(x as number, y as number, z as number));
  }
  return most;
}

/** Six times the volume that a corner's place spans with the two others about the origin. */
function spanned(x: ArrayLike<number>, a: number, b: number, c: number): number {
  const [ax, ay, az] = [x[a] as number, x[a + 1] as number, x[a + 2] as number];
  const [bx, by, bz] = [x[b] as number, x[b + 1] as number, x[b + 2] as number];
  const [cx, cy, cz] = [x[c] as number, x[c + 1] as number, x[c + 2] as number];
  return ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
}

/** Volume inside of a closed surface [m³]. */
export function enclosedVolume(places: ArrayLike<number>, triangles: Uint32Array): number {
  let six = 0;
  for (let t = 0; t < triangles.length; t += 3)
    six += spanned(
      places,
      3 * (triangles[t] as number),
      3 * (triangles[t + 1] as number),
      3 * (triangles[t + 2] as number),
    );
  return Math.abs(six) / 6;
}
