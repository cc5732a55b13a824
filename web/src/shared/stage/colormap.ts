// Colour scales by number. Anchors: viridis (Smith and van der Walt, matplotlib, 2015) at every
// tenth, and ColorBrewer RdBu (Harrower and Brewer, The Cartographic Journal 40, 2003) reversed.

const VIRIDIS = '440154 482475 414487 355f8d 2a788e 21918c 22a884 44bf70 7ad151 bddf26 fde725';
const RED_BLUE = '2166ac 4393c3 92c5de d1e5f0 f7f7f7 fddbc7 f4a582 d6604d b2182b';

/** Entries of a table: more than a display's 8 bits could tell apart along these scales. */
const TABLE_SIZE = 256;

export interface Colormap {
  /** Linear-light red, green, blue of each entry, 0 to 1. */
  table: Float32Array;
  /** The scale as a CSS gradient, first entry on the left. */
  gradient: string;
}

function linearFromSrgb(value: number): number {
  return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
}

function channel(anchor: string, index: number): number {
  return Number.parseInt(anchor.slice(2 * index, 2 * index + 2), 16) / 255;
}

/** Linear red, green, blue of "#rrggbb". */
export function linearColour(hex: string): [number, number, number] {
  const digits = hex.slice(1);
  return [0, 1, 2].map((index) => linearFromSrgb(channel(digits, index))) as [
    number,
    number,
    number,
  ];
}

function colormapFrom(anchors: string): Colormap {
  const stops = anchors.split(' ');
  const table = new Float32Array(3 * TABLE_SIZE);
  for (let entry = 0; entry < TABLE_SIZE; ++entry) {
    const place = (entry / (TABLE_SIZE - 1)) * (stops.length - 1);
    const below = Math.min(Math.floor(place), stops.length - 2);
    const part = place - below;
    for (let c = 0; c < 3; ++c) {
      const from = channel(stops[below] ?? '000000', c);
      const to = channel(stops[below + 1] ?? '000000', c);
      table[3 * entry + c] = linearFromSrgb(from + part * (to - from));
    }
  }
  const css = stops.map((stop) => `#${stop}`).join(', ');
  return { table, gradient: `linear-gradient(to right, ${css})` };
}

export const MAGNITUDE_MAP = colormapFrom(VIRIDIS);
export const SIGNED_MAP = colormapFrom(RED_BLUE);

/** The upper end of an automatic scale: the next 1, 2 or 5 times a power of ten. */
export function roundedUp(value: number): number {
  if (!(value > 0)) return 0;
  const power = 10 ** Math.floor(Math.log10(value));
  const nice = [1, 2, 5, 10].find((factor) => value <= factor * power * (1 + 1e-9)) ?? 10;
  return nice * power;
}

/** A grey for places without a number: neither scale has it. */
const NO_NUMBER = 0.2;

/**
 * Writes the colour of each value into `colours`, three numbers a value; ends are clamped, and NaN
 * is grey.
 */
export function paint(
  map: Colormap,
  values: Float32Array,
  low: number,
  high: number,
  colours: Float32Array,
): void {
  const scale = high > low ? (TABLE_SIZE - 1) / (high - low) : 0;
  for (let v = 0; v < values.length; ++v) {
    const value = values[v] ?? Number.NaN;
    if (Number.isNaN(value)) {
      colours.fill(NO_NUMBER, 3 * v, 3 * v + 3);
      continue;
    }
    const place = Math.round((value - low) * scale);
    const entry = 3 * Math.min(TABLE_SIZE - 1, Math.max(0, place));
    colours[3 * v] = map.table[entry] ?? 0;
    colours[3 * v + 1] = map.table[entry + 1] ?? 0;
    colours[3 * v + 2] = map.table[entry + 2] ?? 0;
  }
}
