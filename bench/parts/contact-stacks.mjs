// Scenes in which layers of cloth lie on each other: stacks, piles, cloth that gathers in a funnel.
import { sheetsMesh, zigzagPlaces } from './contact-places.mjs';
import { kAir, kFloor, sheet } from './contact-world.mjs';

const kBall = { centre_m: [0, 0, 0], radius_m: 0.2 };

const range = (n) => Array.from({ length: n }, (_, k) => k);

/** n x n cells each, level, the lowest at `height` [m], `gap` [m] apart. */
const level = (layers, n, cell, height, gap) =>
  sheetsMesh(
    range(layers).map((k) => ({
      columns: n,
      rows: n,
      cell,
      corner: [(-n * cell) / 2, height + k * gap, (-n * cell) / 2],
      warp: [0, 0, 1],
      weft: [1, 0, 0],
    })),
  );

/** A strip of as many layers, in a zigzag: of one piece, for steppers that need threads. */
const zigzag = (layers, n, cell, height, gap) => ({
  cloth: sheet(n, layers * n, cell, [0, 0, 0], [0, 0, 1]),
  start: { positions_m: zigzagPlaces(n, layers, n, cell, gap, height) },
});

/** Ten layers that come down on a floor; sheets of their own, or one strip. */
const kTen = { fabric: { name: 'fine cotton' }, world: { ...kAir, colliders: [kFloor] } };
export const tenLayers = (n = 5) => ({
  ...kTen,
  name: 'ten layers',
  cloth: level(10, n, 0.2 / n, 0.005, 0.003),
  duration_s: 1.5,
});
export const tenFolds = (n = 5) => ({
  ...kTen,
  name: 'strip in ten layers',
  ...zigzag(10, n, 0.2 / n, 0.005, 0.003),
  duration_s: 1.5,
});

/** Three layers that come down on a ball; sheets of their own, or one strip. */
const kThree = { fabric: { name: 'linen' }, world: { ...kAir, colliders: [{ sphere: kBall }] } };
const kAbove = kBall.radius_m + 0.003;
export const threeSheets = (n = 6) => ({
  ...kThree,
  name: 'three sheets on a ball',
  cloth: level(3, n, 0.3 / n, kAbove, 0.004),
  duration_s: 1.5,
});
export const threeFolds = (n = 6) => ({
  ...kThree,
  name: 'strip in three layers on a ball',
  ...zigzag(3, n, 0.3 / n, kAbove, 0.004),
  duration_s: 1.5,
});

/** Ribbons that stand in a ring on their ends, and come down in a pile. */
export function ribbonPile(rows = 24) {
  const kRibbons = 8;
  const cell = 0.36 / rows;
  const ribbons = range(kRibbons).map((k) => {
    const angle = (2 * Math.PI * k) / kRibbons;
    const out = [Math.cos(angle), 0, Math.sin(angle)];
    const weft = [-out[2], 0, out[0]];
    const corner = [
      0.05 * out[0] - cell * weft[0],
      0.37 + 0.01 * k,
      0.05 * out[2] - cell * weft[2],
    ];
    return { columns: 2, rows, cell, corner, warp: [0, -1, 0], weft };
  });
  return {
    name: 'pile of ribbons',
    cloth: sheetsMesh(ribbons),
    fabric: { name: 'linen' },
    world: { ...kAir, gravity_m_per_s2: [0.4, -9.8, 0.3], colliders: [kFloor] },
    duration_s: 1.5,
  };
}

/** One long ribbon, let fall on its end. */
export function pouredRibbon(columns = 2) {
  const cell = 0.03 / columns;
  const rows = 40 * columns;
  return {
    name: 'ribbon that is poured',
    cloth: sheet(columns, rows, cell, [-0.015, rows * cell + 0.01, 0], [0, -1, 0]),
    fabric: { name: 'linen' },
    world: { ...kAir, gravity_m_per_s2: [0.3, -9.8, 0.4], colliders: [kFloor] },
    duration_s: 1.5,
  };
}

/** Eight walls that lean outward from one point: cloth gathers where they meet. */
export function funnel(n = 20) {
  const kSteep = 0.96; // rad, of the walls
  const cell = 0.4 / n;
  const walls = range(8).map((k) => {
    const angle = (2 * Math.PI * k) / 8;
    const normal = [
      -Math.sin(kSteep) * Math.cos(angle),
      Math.cos(kSteep),
      -Math.sin(kSteep) * Math.sin(angle),
    ];
    return { plane: { point_m: [0, 0, 0], normal }, friction: 0.1 };
  });
  return {
    name: 'sheet in a funnel',
    cloth: sheet(n, n, cell, [-0.21, 0.5, -0.19], [0, 0, 1]),
    fabric: { name: 'fine cotton' },
    world: { ...kAir, colliders: walls },
    duration_s: 1.2,
  };
}
