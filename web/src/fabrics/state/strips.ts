// Strips of all fabrics over an edge: the scene of each, and how far one droops.
import stripText from '../../../../assets/scenes/strip.json?raw';
import type { Triple } from '../../shared/bindings/geometry';
import { fabrics } from '../../shared/fabric/fabric-data';
import { bendingLength } from './bending-length';

interface StripScene {
  cloth: {
    sheet: { width_m: number; height_m: number; columns: number; origin_m: Triple };
  };
  [part: string]: unknown;
}

/** The strip runs along z, over an edge at z = 0: half a cell before its last held row, which bends as well. */
export const STRIP = JSON.parse(stripText) as StripScene;

const { width_m, height_m, columns, origin_m } = STRIP.cloth.sheet;

export const WIDTH_M = width_m;

/** The part that lies on the table [m]. */
export const LYING_M = -origin_m[2];

/** The part that hangs over the edge [m]. */
export const OVERHANG_M = height_m - LYING_M;

/** Places of a strip, row by row from the held end, three numbers each [m]. */
type Places = ArrayLike<number>;

export function stripTextOf(fabric: string): string {
  return JSON.stringify({ ...STRIP, fabric: { name: fabric } });
}

/** Middle of the last row [m]. */
export function tipOf(places: Places): Triple {
  const nInRow = columns + 1;
  const middle: Triple = [0, 0, 0];
  for (let k = places.length - 3 * nInRow; k < places.length; ++k)
    middle[k % 3] = (middle[k % 3] ?? 0) + (places[k] ?? 0) / nInRow;
  return middle;
}

/** Angle below the level of the straight line from the edge to the strip's end [degrees]. */
export function droopOf(places: Places): number {
  const [, height, out] = tipOf(places);
  return (180 / Math.PI) * Math.atan2(-height, out);
}

/** Names of all fabrics, the one with the longest bending length first. */
export function namesByBendingLength(): string[] {
  return [...fabrics]
    .sort((a, b) => bendingLength(b) - bendingLength(a))
    .map(({ name_en: name }) => name);
}
