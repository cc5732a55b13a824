// A smooth or rough ball, and what slides off it from near its top: one face, and sheets.
import { tell } from './bench-options.mjs';
import { fabricNumber, meanOf, withStepper } from './same-cloth-scenes.mjs';
import { beadOnBall, sheetOnBall } from './sliding-sheet.mjs';

const kRadius = 0.25; // [m]
const kFabric = 'linen';
const kTolerances = { 240: 0.05, 960: 0.01 }; // shares of the way, by steps per second

/** Distance from the ball's centre at which vertices of square cells are held. */
const reachOf = (cell) => {
  const half = fabricNumber(kFabric, 'thickness_m') / 2;
  const corner = cell / Math.SQRT2; // radius of a cell's faces
  return half + Math.hypot(kRadius, corner);
};

/**
 * A square of n x n cells, tangent to the ball at the angle `begin` off its top, its middle `high`
 * off the centre.
 */
function scene({ n, cell, begin, high, mu, seconds }) {
  const [s, c] = [Math.sin(begin), Math.cos(begin)];
  const half = (n * cell) / 2;
  return {
    name: 'off a ball',
    cloth: {
      sheet: {
        width_m: n * cell,
        height_m: n * cell,
        columns: n,
        rows: n,
        origin_m: [high * s - half * c, high * c + half * s, -half],
        warp_direction: [0, 0, 1],
        weft_direction: [c, -s, 0],
      },
    },
    fabric: { name: kFabric },
    world: { colliders: [{ sphere: { centre_m: [0, 0, 0], radius_m: kRadius }, friction: mu }] },
    duration_s: seconds,
  };
}

/** Places of the scene's vertices at the start. */
export function placesOf({ cloth: { sheet } }) {
  const { columns, rows, width_m, height_m, origin_m, warp_direction, weft_direction } = sheet;
  return Array.from({ length: (columns + 1) * (rows + 1) }, (_, i) => {
    const across = (width_m * (i % (columns + 1))) / columns;
    const along = (height_m * Math.floor(i / (columns + 1))) / rows;
    return origin_m.map((x, k) => x + across * weft_direction[k] + along * warp_direction[k]);
  });
}

const apart = (a, b) => Math.hypot(...a.map((x, k) => x - b[k]));

/** Cases of one scene at each of `rates` [steps per second], against the mean place `right`. */
function casesOf(name, made, right, source, rates, leftOut = {}) {
  const way = apart(right, meanOf(placesOf(made)));
  return rates.map((rate) => ({
    name: `${name}, 1/${rate} s`,
    source,
    of: (stepper) => leftOut[stepper] ?? withStepper(made, stepper, { step_s: 1 / rate }),
    measures: [
      {
        of: 'distance over way',
        unit: '',
        right: 0,
        tolerance: kTolerances[rate],
        value: ({ positions }) => apart(meanOf(positions), right) / way,
      },
    ],
  }));
}

const kFrictions = [0, 0.2];

/** One face of 1 cm, against a bead at the height of its middle. */
export function beads() {
  const [cell, seconds, rates] = [0.01, 0.4, [240, 960]];
  const high = Math.sqrt(reachOf(cell) ** 2 - cell ** 2 / 2) + 1e-7;
  return kFrictions.flatMap((mu) => {
    const begin = Math.asin((mu ? 0.1 : 0.05) / kRadius);
    const made = scene({ n: 1, cell, begin, high, mu, seconds });
    const right = [...beadOnBall({ radius: high, begin, mu, seconds }), 0];
    return casesOf(`face of 1 cm off a ball, mu ${mu}`, made, right, 'bead', rates);
  });
}

const [kSize, kSeconds, kMiddle] = [0.08, 0.35, 0.12]; // [m], [s], [m] across from the top

/** A sheet of n x n cells that leaves the ball from `kMiddle` on. */
export function sheetScene(n, mu) {
  const cell = kSize / n;
  const begin = Math.asin(kMiddle / kRadius);
  return scene({ n, cell, begin, high: reachOf(cell) + 1e-7, mu, seconds: kSeconds });
}

/** Mean place at the end of the same sheet, in explicit steps of our own. */
export function ownEnd(n, mu) {
  const kStepOfACell = 2.4e-3; // [s/m]: two thirds of what threads of linen bear
  const number = (key) => fabricNumber(kFabric, key);
  const atRest = (thread) => {
    const kCurvature = 30; // [1/m] of bending "at_rest"
    return number(`bend_${thread}_n_m`) + number('bend_hysteresis_2hb_n') / 2 / kCurvature;
  };
  const cell = kSize / n;
  const positions = placesOf(sheetScene(n, mu));
  const fabric = {
    density: number('areal_density_kg_per_m2'),
    warp: number('stretch_warp_n_per_m'),
    weft: number('stretch_weft_n_per_m'),
    shear: number('shear_n_per_m'),
    bendWarp: atRest('warp'),
    bendWeft: atRest('weft'),
  };
  const step = kStepOfACell * cell;
  return sheetOnBall({
    positions,
    n,
    cell,
    fabric,
    reach: reachOf(cell),
    mu,
    seconds: kSeconds,
    step,
  });
}

const ownEnds = new Map();

/** End of our own sheet by friction, the same for all meshes. */
function knownEnd(mu) {
  if (!ownEnds.has(mu)) {
    tell(`own integrator, mu ${mu}`);
    ownEnds.set(mu, ownEnd(12, mu));
  }
  return ownEnds.get(mu);
}

/**
 * Cases of n x n cells, against 12 x 12 of our own, which end within 0.1 % of the way of 16 x 16.
 */
function sheetCases(n, rates, leftOut) {
  return kFrictions.flatMap((mu) => {
    const source = 'sheet of springs in explicit steps, computed in the bench';
    const name = `${n + 1}x${n + 1} off a ball, mu ${mu}`;
    return casesOf(name, sheetScene(n, mu), knownEnd(mu), source, rates, leftOut);
  });
}

const kAsLong = 'the same substeps as at 1/240 s';
const kCostly = 'minutes of small substeps';

/** 33x33. `rk4` has the substeps of `explicit`, four times as dear. */
export const sheets = () => [
  ...sheetCases(32, [240], { rk4: kCostly }),
  ...sheetCases(32, [960], { explicit: kAsLong, rk4: kCostly }),
];

export const largeSheets = () => sheetCases(64, [240], { explicit: kCostly, rk4: kCostly });
