// A dress as users bring them: tens of thousands of vertices in several pieces, crumpled in every
// wavelength, no two triangles alike, some of them slivers.

/** Numbers in [0, 1) that are the same each time: mulberry32. */
function seeded(seed) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

const kLength = 1.1; // [m]
const kTop = 1.4; // height of its upper edge [m]
const kRadii = [0.13, 0.33]; // radii at its upper and its lower edge [m]

/** Waves of all lengths from 2 to 20 cm, each a twelfth as high as long, in all directions. */
function crumpling(random) {
  const kWaves = 24;
  const waves = Array.from({ length: kWaves }, (_, k) => {
    const length = 0.02 * 10 ** (k / (kWaves - 1));
    const [x, y, z] = [0, 1, 2].map(() => random() - 0.5);
    const scale = (2 * Math.PI) / (length * Math.hypot(x, y, z));
    return { wave: [x * scale, y * scale, z * scale], phase: 7 * random(), height: length / 12 };
  });
  const share = 1 / Math.sqrt(kWaves / 3);
  return (x, y, z) =>
    waves.reduce(
      (sum, { wave: [a, b, c], phase, height }) =>
        sum + share * height * Math.sin(a * x + b * y + c * z + phase),
      0,
    );
}

/** Places of vertices in a grid: inner ones are moved, some nearly onto their neighbour. */
function unequalGrid(around, along, random) {
  const kJitter = 0.4; // share of a cell, to each side
  const kSlivers = 0.03; // share of the vertices
  const kSliver = 0.01; // share of the distance to the neighbour that is left
  const grid = [];
  for (let row = 0; row < along; ++row) {
    const inside = row > 0 && row < along - 1;
    const jitter = () => (inside ? kJitter * (2 * random() - 1) : 0);
    const places = Array.from({ length: around }, (_, column) => [
      column + jitter(),
      row + jitter(),
    ]);
    for (let column = 1; inside && column < around; ++column) {
      const [[u0, v0], [u, v]] = [places[column - 1], places[column]];
      if (random() < kSlivers) places[column] = [u0 + kSliver * (u - u0), v0 + kSliver * (v - v0)];
    }
    grid.push(places);
  }
  return grid;
}

/**
 * The dress as an OBJ: flounces one below the other, each a piece of its own that hangs from its
 * group "seam".
 *
 * around, along  vertices of each flounce: `around` of a ring, `along` rings
 */
export function crumpledDress(around, along, flounces) {
  const random = seeded(28_467);
  const crumple = crumpling(random);
  const lines = ['o dress'];
  const at = (u, v) => {
    const share = v / (along * flounces - 1);
    const angle = (2 * Math.PI * u) / around;
    const [x, y, z] = [Math.sin(angle), kTop - kLength * share, Math.cos(angle)];
    const radius = kRadii[0] + share * (kRadii[1] - kRadii[0]);
    const r = radius + crumple(radius * x, y, radius * z);
    return [r * x, y, r * z];
  };
  for (let flounce = 0; flounce < flounces; ++flounce) {
    const first = flounce * along;
    for (const [u, v] of unequalGrid(around, along, random).flat()) {
      const place = at(u, first + v);
      lines.push(`v ${place.map((value) => value.toFixed(7)).join(' ')}`);
    }
    const corner = (row, column) => (first + row) * around + (column % around) + 1;
    for (let row = 0; row + 1 < along; ++row) {
      if (row < 2) lines.push(row === 0 ? 'g seam' : 'g free');
      for (let column = 0; column < around; ++column) {
        const [a, b] = [corner(row, column), corner(row, column + 1)];
        const [c, d] = [corner(row + 1, column + 1), corner(row + 1, column)];
        if (random() < 0.5) lines.push(`f ${a} ${d} ${c}`, `f ${a} ${c} ${b}`);
        else lines.push(`f ${a} ${d} ${b}`, `f ${b} ${d} ${c}`);
      }
    }
  }
  return `${lines.join('\n')}\n`;
}

/** A scene of the dress, but for its name and method. */
export const dressScene = (file) => ({
  cloth: { mesh: { obj: file, warp_direction: [0, -1, 0] } },
  fabric: { name: 'fine cotton' },
  pins: [{ part: 'seam' }],
});
