// Places in which cloth starts: in layers, rolled up, in waves, along a curve; each as long between
// its vertices as it is at rest. And meshes of several sheets that nothing joins.

const range = (n) => Array.from({ length: n }, (_, k) => k);
const along = (place, direction, way) => place.map((x, k) => x + way * direction[k]);
const distance = (a, b) => Math.hypot(...a.map((x, k) => x - b[k]));

/** place(row, column) of all vertices of a sheet, in their order. */
const placesOf = (columns, rows, place) =>
  range(rows + 1).flatMap((row) => range(columns + 1).map((column) => place(row, column)));

/**
 * Layers of `cells` rows of cells upon each other, `gap` [m] apart, each going back from where the
 * one below it ends, with a first cell that is aslant. Rows run along z.
 */
export function zigzagPlaces(columns, layers, cells, cell, gap, height) {
  const profile = [[height, (-cells * cell) / 2]];
  for (const layer of range(layers))
    for (const k of range(cells)) {
      const [y, z] = profile.at(-1);
      const up = layer > 0 && k === 0 ? gap : 0;
      const way = Math.sqrt(cell ** 2 - up ** 2);
      profile.push([y + up, z + (layer % 2 ? -way : way)]);
    }
  return placesOf(columns, layers * cells, (row, column) => [
    (column - columns / 2) * cell,
    ...profile[row],
  ]);
}

/** Rolled up about a line along y, a cell wide of a whole round left open; rows go down. */
export function rolledPlaces(columns, rows, cell, height) {
  const step = (2 * Math.PI) / (columns + 1);
  const radius = cell / (2 * Math.sin(step / 2));
  return placesOf(columns, rows, (row, column) => [
    radius * Math.cos(column * step),
    height - row * cell,
    radius * Math.sin(column * step),
  ]);
}

/**
 * Waves down the rows: the slope goes as cos of the way along them, with `slope` [rad] at most.
 *
 * Returns places and how high the sheet is in them [m].
 */
export function wavePlaces(columns, rows, cell, waves, slope, height) {
  const profile = [[height, 0]];
  for (const row of range(rows)) {
    const angle = slope * Math.cos((2 * Math.PI * waves * (row + 0.5)) / rows);
    const [y, z] = profile.at(-1);
    profile.push([y - cell * Math.cos(angle), z + cell * Math.sin(angle)]);
  }
  const places = placesOf(columns, rows, (row, column) => [
    (column - columns / 2) * cell,
    ...profile[row],
  ]);
  return { places, height: height - profile.at(-1)[0] };
}

/** Places of a curve with its length up to each. */
function measured(curve) {
  let length = 0;
  return curve.map((place, k) => {
    if (k > 0) length += distance(place, curve[k - 1]);
    return { place, length };
  });
}

/** So many places more than one at even ways along a curve of pieces, with its direction there. */
function evenly(curve, n) {
  const pieces = measured(curve);
  return range(n + 1).map((k) => {
    const length = (k / n) * pieces.at(-1).length;
    const next = Math.max(
      1,
      pieces.findIndex((piece) => piece.length >= length),
    );
    const [before, after] = [pieces[next - 1], pieces[next]];
    const size = after.length - before.length;
    const direction = after.place.map((x, i) => (x - before.place[i]) / size);
    return { place: along(before.place, direction, length - before.length), direction };
  });
}

/** The value at x of a table of [x, y], which is level at each of its places. */
function smooth(table, x) {
  const next = Math.max(
    1,
    table.findIndex(([end]) => x <= end),
  );
  const [[x0, y0], [x1, y1]] = [table[next - 1], table[next]];
  return y0 + ((y1 - y0) * (1 - Math.cos((Math.PI * (x - x0)) / (x1 - x0)))) / 2;
}

const kKnotEnd = 2.15;
const kKnotPieces = 4000;
/** Meetings of (t^3 - 3 t, t^4 - 4 t^2) with itself: three places, each twice, each other one above. */
const kKnotMeetings = [-1, 1].flatMap((sign) => {
  const half = (root) => (Math.sqrt(6) + root * Math.sqrt(2)) / 2;
  return [half(-sign), Math.sqrt(3), half(sign)].map((t) => sign * t);
});

/**
 * An open overhand knot in the plane of x and y, `rise` [m] above and below it in turn where it
 * meets itself: the curve by which Shastri (1992) writes the trefoil, of so long a way [m].
 */
function knot(length, rise) {
  const curve = range(kKnotPieces + 1).map((k) => {
    const t = kKnotEnd * ((2 * k) / kKnotPieces - 1);
    return [t ** 3 - 3 * t, t ** 4 - 4 * t ** 2, 0];
  });
  const flat = measured(curve);
  const size = length / flat.at(-1).length;
  const piece = (t) => Math.round(((t / kKnotEnd + 1) / 2) * kKnotPieces);
  const heights = [
    [0, 0],
    ...kKnotMeetings.map((t, k) => [flat[piece(t)].length, k % 2 ? -rise : rise]),
    [flat.at(-1).length, 0],
  ];
  return flat.map(({ place: [x, y], length: way }) => [size * x, size * y, smooth(heights, way)]);
}

/**
 * A ribbon laid as an open overhand knot, its width across the plane of the knot: what rises and
 * falls draws the rest of it a little together.
 */
export function knotPlaces(columns, rows, cell, rise) {
  const curve = knot(rows * cell, rise);
  const share = (rows * cell) / measured(curve).at(-1).length;
  const line = evenly(curve, rows);
  return placesOf(columns, rows, (row, column) => {
    const { place, direction } = line[row];
    const [x, y, z] = direction;
    const size = Math.hypot(x, y);
    const across = [(-z * x) / size, (-z * y) / size, size];
    const way = (column - columns / 2) * cell;
    return along(
      place.map((coordinate) => share * coordinate),
      across,
      way,
    );
  });
}

/**
 * A section "cloth": sheets that nothing joins, each of columns x rows cells.
 *
 * sheets: [{columns, rows, cell [m], corner [m], warp, weft}], unit vectors down rows and along them
 */
export function sheetsMesh(sheets) {
  const positions_m = [];
  const triangles = [];
  const warp_directions = [];
  for (const { columns, rows, cell, corner, warp, weft } of sheets) {
    const first = positions_m.length;
    const place = (row, column) => along(along(corner, warp, row * cell), weft, column * cell);
    positions_m.push(...placesOf(columns, rows, place));
    for (const row of range(rows))
      for (const column of range(columns)) {
        const a = first + row * (columns + 1) + column;
        const below = a + columns + 1;
        triangles.push([a, below, a + 1], [a + 1, below, below + 1]);
        warp_directions.push(warp, warp);
      }
  }
  return { mesh: { positions_m, triangles, warp_directions } };
}

/** A section "cloth": a tube about a line along y, its ends in the groups "upper" and "lower". */
export function tubeMesh(around, rows, cell, height) {
  const radius = cell / (2 * Math.sin(Math.PI / around));
  const angle = (column) => (2 * Math.PI * column) / around;
  const positions_m = placesOf(around - 1, rows, (row, column) => [
    radius * Math.cos(angle(column)),
    height - row * cell,
    radius * Math.sin(angle(column)),
  ]);
  const triangles = range(rows).flatMap((row) =>
    range(around).flatMap((column) => {
      const [a, b] = [column, (column + 1) % around].map((k) => row * around + k);
      return [
        [a, b, a + around],
        [b, b + around, a + around],
      ];
    }),
  );
  const groups = { upper: range(around), lower: range(around).map((k) => rows * around + k) };
  return { mesh: { positions_m, triangles, warp_direction: [0, -1, 0], groups } };
}
