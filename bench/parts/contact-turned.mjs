// Scenes in which pins turn or pull cloth until it lies tight on itself.
import { knotPlaces, rolledPlaces, tubeMesh, wavePlaces } from './contact-places.mjs';

const kStill = { gravity_m_per_s2: [0, 0, 0], air: {} };

const sheet = (columns, rows, cell) => ({
  sheet: {
    width_m: columns * cell,
    height_m: rows * cell,
    columns,
    rows,
    warp_direction: [0, -1, 0],
    weft_direction: [1, 0, 0],
  },
});

/** Both ends turn about the line along y through the origin, against each other. */
const turned = (parts, rad_per_s, end_s) =>
  parts.map((part, k) => ({
    part,
    motion: { kind: 'turn', axis: [0, 1, 0], rad_per_s: k ? -rad_per_s : rad_per_s, end_s },
  }));

const kEdges = ['upper_edge', 'lower_edge'];

/** Hung in waves between its ends, which turn by pi/3 rad/s each: 3.3 turns in 10 s. */
export function spunSheet(columns = 6, end_s = 10) {
  const cell = 0.24 / columns;
  const rows = 3 * columns;
  const { places } = wavePlaces(columns, rows, cell, 2, 0.8, 0.8);
  return {
    name: 'sheet twisted at both ends',
    cloth: sheet(columns, rows, cell),
    fabric: { name: 'fine cotton' },
    start: { positions_m: places },
    pins: turned(kEdges, Math.PI / 3, end_s),
    world: { air: {} },
    duration_s: end_s,
  };
}

const kTube = { fabric: { name: 'fine cotton' }, world: { air: {} }, duration_s: 4 };

/** Ends of the tube turn by two turns each. */
const kTubeSpeed = (2 * 2 * Math.PI) / kTube.duration_s;

/** A sheet rolled up as a tube, which stays open by a cell. */
export function rolledTube(around = 8) {
  const cell = 0.3 / around;
  const rows = 3 * around;
  return {
    ...kTube,
    name: 'rolled tube twisted by four turns',
    cloth: sheet(around, rows, cell),
    start: { positions_m: rolledPlaces(around, rows, cell, 1) },
    pins: turned(kEdges, kTubeSpeed, kTube.duration_s),
  };
}

/** Closed, and a mesh therefore. */
export function closedTube(around = 8) {
  const cell = 0.3 / around;
  return {
    ...kTube,
    name: 'tube twisted by four turns',
    cloth: tubeMesh(around, 3 * around, cell, 1),
    pins: turned(['upper', 'lower'], kTubeSpeed, kTube.duration_s),
  };
}

/** A ribbon without weight in an open overhand knot, which is pulled tight by its ends. */
export function tightKnot(columns = 2) {
  const cell = 0.02 / columns;
  const rows = 60 * columns;
  const places = knotPlaces(columns, rows, cell, 0.02);
  const kLeft = 0.18; // m of ribbon left in the knot
  const [first, last] = [places[0], places.at(-1)];
  const pulled = (part, sign) => {
    const offset_m = [(sign * (rows * cell - kLeft - Math.abs(last[0] - first[0]))) / 2, 0, 0];
    return { part, motion: { kind: 'ease', offset_m, begin_s: 0, end_s: 1.5 } };
  };
  return {
    name: 'knot pulled tight',
    cloth: sheet(columns, rows, cell),
    fabric: { name: 'fine cotton' },
    start: { positions_m: places },
    pins: [pulled('upper_edge', -1), pulled('lower_edge', 1)],
    world: kStill,
    duration_s: 2,
  };
}
