// Places as three numbers.
import type { Triple } from '../bindings/geometry';

/** The place of a vertex among places, three numbers each. */
export function placeOf(values: ArrayLike<number>, vertex: number): Triple {
  return [values[3 * vertex] ?? 0, values[3 * vertex + 1] ?? 0, values[3 * vertex + 2] ?? 0];
}

export function minus(a: Triple, b: Triple): Triple {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function dot(a: Triple, b: Triple): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function cross(a: Triple, b: Triple): Triple {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/** The ends of the box around places, three numbers each. */
export function boxOf(places: ArrayLike<number>): { low: Triple; high: Triple } {
  const low: Triple = [Infinity, Infinity, Infinity];
  const high: Triple = [-Infinity, -Infinity, -Infinity];
  for (let k = 0; k < places.length; ++k) {
    const axis = (k % 3) as 0 | 1 | 2;
    low[axis] = Math.min(low[axis], places[k] as number);
    high[axis] = Math.max(high[axis], places[k] as number);
  }
  return { low, high };
}

/** The diagonal of the box around places. */
export function extentOf(places: ArrayLike<number>): number {
  const { low, high } = boxOf(places);
  return Math.hypot(...minus(high, low));
}
