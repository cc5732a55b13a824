// Draws a knit: plain wales as stitches of two legs, lace as holes with yarn around. One texture repeats over the
// cloth, and lies on it by the places of its particles at rest.
import {
  DataTexture,
  LinearFilter,
  LinearMipmapLinearFilter,
  RepeatWrapping,
  SRGBColorSpace,
} from 'three';
import type { Print } from '../../shared/stage/fabric-material';
import type { Knit } from '../state/knit';

/** Pixels along a side of a stitch. */
const STITCH_PX = 20;
/** Stitches between two particles, where these are far apart and where they are near. */
const STITCHES_FAR = 2;
const STITCHES_NEAR = 1;
const NEAR_COLUMNS = 48;
/** Holes come in every second course. */
const COURSES = 2;
/** Sharp as far as most graphics go where the cloth is seen along. */
const ANISOTROPY = 8;

/** Measures of a leg, in stitches: from the edge of a stitch to its middle, reaching into those above and below. */
const LEG = { from: 0.45, to: 0.05, above: 0.25, length: 1.5, half: 0.19 };
/** Measures of the yarn around a hole, in stitches. */
const EYELET = { hole: 0.37, yarn: 0.56, half: 0.19 };

/** Stitches between holes lie that much lower than plain ones. */
const LACE_BETWEEN = 0.7;

/** Light of what lies lowest, as a share of the highest. */
const DARKEST = 0.3;

/** Half of a circle over -1 to 1: how high a yarn is across. */
function roundness(across: number): number {
  return Math.sqrt(Math.max(0, 1 - across * across));
}

/** Height of plain stitches at (x, y), in stitches, 0 to 1. */
function plainHeight(x: number, y: number): number {
  const fromMiddle = Math.abs((x % 1) - 0.5);
  let highest = 0;
  for (const course of [-1, 0, 1]) {
    const along = ((y % 1) + LEG.above + course) / LEG.length;
    if (along < 0 || along > 1) continue;
    const middle = LEG.from + (LEG.to - LEG.from) * along;
    const leg = roundness((fromMiddle - middle) / LEG.half) * roundness(2 * along - 1);
    highest = Math.max(highest, leg);
  }
  return highest;
}

/** How high the yarn is, 0 to 1, and how much of the place it fills, 0 in a hole. */
interface Yarn {
  height: number;
  cover: number;
}

/** Lace has a hole in every second stitch of a course, set off in the next. */
function laceAt(x: number, y: number): Yarn {
  let toHole = Number.POSITIVE_INFINITY;
  for (let column = Math.floor(x) - 1; column <= x + 1; ++column)
    for (let course = Math.floor(y) - 1; course <= y + 1; ++course) {
      if ((column + course) % 2 !== 0) continue;
      toHole = Math.min(toHole, Math.hypot(x - column - 0.5, y - course - 0.5));
    }
  const around = roundness((toHole - EYELET.yarn) / EYELET.half);
  const cover = (toHole - EYELET.hole) * STITCH_PX + 0.5; // a pixel wide: edges are smooth
  return {
    height: Math.max(around, LACE_BETWEEN * plainHeight(x, y)),
    cover: Math.min(Math.max(cover, 0), 1),
  };
}

function stitchesOf({ columns }: Knit): number {
  return columns > NEAR_COLUMNS ? STITCHES_NEAR : STITCHES_FAR;
}

function periodOf(knit: Knit): number {
  return knit['pattern/plain_columns'] + knit['pattern/lace_columns'];
}

/** Wales that the texture has: a period of the pattern, or as many as there are. */
function walesOf(knit: Knit): number {
  return Math.min(periodOf(knit), knit.columns);
}

export interface Pixels {
  width: number;
  height: number;
  /** Red, green, blue and how much is there, row by row. */
  data: Uint8Array<ArrayBuffer>;
}

/** The pattern once, by whole wales and two courses of stitches. */
export function knitPixels(knit: Knit): Pixels {
  const stitches = stitchesOf(knit);
  const width = walesOf(knit) * stitches * STITCH_PX;
  const height = COURSES * STITCH_PX;
  const data = new Uint8Array(4 * width * height);
  for (let row = 0; row < height; ++row)
    for (let column = 0; column < width; ++column) {
      const [x, y] = [(column + 0.5) / STITCH_PX, (row + 0.5) / STITCH_PX];
      const isLace = Math.floor(x / stitches) >= knit['pattern/plain_columns'];
      const { height: yarn, cover } = isLace
        ? laceAt(x, y)
        : { height: plainHeight(x, y), cover: 1 };
      const light = Math.round(255 * (DARKEST + (1 - DARKEST) * yarn));
      data.set([light, light, light, Math.round(255 * cover)], 4 * (row * width + column));
    }
  return { width, height, data };
}

/** Place of each particle in the texture: in the middle of its wale. */
export function knitCoordinates(knit: Knit): Float32Array {
  const { columns, rows } = knit;
  const coursesPerRow = Math.max(1, Math.round((stitchesOf(knit) * (columns - 1)) / (rows - 1)));
  const coordinates = new Float32Array(2 * columns * rows);
  for (let row = 0; row < rows; ++row)
    for (let column = 0; column < columns; ++column) {
      const place = [(column + 0.5) / walesOf(knit), (row * coursesPerRow) / COURSES];
      coordinates.set(place, 2 * (row * columns + column));
    }
  return coordinates;
}

export function knitPrint(knit: Knit): Print {
  const { data, width, height } = knitPixels(knit);
  const texture = new DataTexture(data, width, height);
  texture.wrapS = RepeatWrapping;
  texture.wrapT = RepeatWrapping;
  texture.magFilter = LinearFilter;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.generateMipmaps = true;
  texture.anisotropy = ANISOTROPY;
  texture.colorSpace = SRGBColorSpace;
  texture.needsUpdate = true;
  return { texture, coordinates: knitCoordinates(knit) };
}
