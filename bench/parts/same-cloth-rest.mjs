// Cloth at rest whose shape is known: a strip that droops, a sheet between two rails, a limp
// curtain in wind, and a flag that the air brakes.
import { reference } from './command.mjs';
import { explicitOnes } from './same-cloth-runs.mjs';
import { fabricNumber, kAirDensity, kGravity, withStepper } from './same-cloth-scenes.mjs';

const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;
const degrees = (angle) => (180 * angle) / Math.PI;

const kSwings = 'swings for long without dampers';
const kBendingLength = 0.05; // [m]: cells of 2 mm and of 25 mm fit into half of it or so
const kStripColumns = 4;

/** The angle below the horizontal of the chord from the clamp, row 1, to the last row [degrees]. */
export function chordAngle(positions, columns = kStripColumns) {
  const row = (r) => positions.slice(r * (columns + 1), (r + 1) * (columns + 1));
  const middle = (places, k) => mean(places.map((place) => place[k]));
  const [clamp, tip] = [row(1), positions.slice(-columns - 1)];
  const [out, down] = [middle(tip, 2) - middle(clamp, 2), middle(clamp, 1) - middle(tip, 1)];
  return degrees(Math.atan2(down, out));
}

/** A strip along z, its first two rows held, `lengths` bending lengths or so in whole cells. */
export function cantileverScene(lengths, cell) {
  const cells = Math.max(1, Math.round((lengths * kBendingLength) / cell));
  const rigidity =
    kGravity * fabricNumber('linen', 'areal_density_kg_per_m2') * kBendingLength ** 3;
  return {
    name: 'cantilever',
    cloth: {
      sheet: {
        width_m: kStripColumns * cell,
        height_m: (cells + 1) * cell,
        columns: kStripColumns,
        rows: cells + 1,
        origin_m: [0, 1, -cell],
        warp_direction: [0, 0, 1],
        weft_direction: [1, 0, 0],
      },
    },
    fabric: {
      name: 'linen',
      bending: 'moving',
      overrides: { bend_warp_n_m: rigidity, bend_weft_n_m: rigidity },
    },
    pins: [{ vertices: [...Array(2 * (kStripColumns + 1)).keys()] }],
    duration_s: 3,
  };
}

/** Three numbers each. */
const triples = (values) =>
  Array.from({ length: values.length / 3 }, (_, i) => values.slice(3 * i, 3 * i + 3));

/** Degrees that a chord may be off: two cells of 25 mm in `implicit` at rest are by 1.2. */
const chordTolerance = (angle, cell) => Math.min(3, Math.max(0.5 + cell / 0.025, 0.07 * angle));

/**
 * The shape with its rows a cell apart along the same chords: coarse rows of an elastica are nearer
 * than that, and cloth that begins compressed swings.
 */
export function unstretched(shape, cell, columns = kStripColumns) {
  const line = columns + 1;
  const places = shape.map((place) => [...place]);
  for (let i = line; i < shape.length; ++i) {
    const way = shape[i].map((x, k) => x - shape[i - line][k]);
    const longer = cell / Math.hypot(...way);
    places[i] = places[i - line].map((x, k) => x + longer * way[k]);
  }
  return places;
}

function cantilever(lengths, cell, isStraight) {
  const scene = cantileverScene(lengths, cell);
  const [{ positions_m }] = reference(scene, 'closed_form', [1]).samples;
  const shape = triples(positions_m);
  const right = chordAngle(shape);
  const inAir = { ...scene, world: { air: {} } };
  const begun = isStraight
    ? { ...inAir, duration_s: 10 }
    : { ...inAir, start: { positions_m: unstretched(shape, cell) } };
  const start = isStraight ? 'from straight' : 'from rest';
  return {
    name: `cantilever of ${lengths} bending lengths, ${1e3 * cell} mm, ${start}`,
    source: 'heavy elastica of length L + c/2',
    of: (stepper) => {
      if (isStraight && explicitOnes.includes(stepper)) return kSwings;
      const isLong = { explicit: cell < 5e-3, rk4: cell < 10e-3 };
      return isLong[stepper] ? 'minutes of small substeps' : withStepper(begun, stepper);
    },
    measures: [
      {
        of: 'chord',
        unit: 'degrees',
        right,
        tolerance: chordTolerance(right, cell),
        value: ({ positions }) => chordAngle(positions),
      },
    ],
  };
}

export function cantilevers() {
  const lengths = [0.5, 1, 2, 4];
  const atRest = [2e-3, 5e-3, 10e-3, 25e-3].flatMap((cell) =>
    lengths.map((length) => cantilever(length, cell, false)),
  );
  return [...atRest, ...lengths.map((length) => cantilever(length, 5e-3, true))];
}

/**
 * The catenary of length 1 whose ends are `span` apart at one height: its parameter a, with
 * 2 a sinh(span/(2 a)) = 1, by bisection.
 */
export function catenaryParameter(span) {
  let [low, high] = [1e-2, 1e2];
  for (let round = 0; round < 200; ++round) {
    const a = Math.sqrt(low * high);
    if (2 * a * Math.sinh(span / (2 * a)) > 1) low = a;
    else high = a;
  }
  return low;
}

export function catenarySag(span) {
  const a = catenaryParameter(span);
  return a * (Math.cosh(span / (2 * a)) - 1);
}

const kSpan = 0.8; // [m] between rails that hold a metre of cloth

/** [along, down] of the catenary at the arc length s from one end. */
export function catenaryPoint(span, s) {
  const a = catenaryParameter(span);
  const x = a * Math.asinh((s - 0.5) / a);
  return [x + span / 2, a * (Math.cosh(span / (2 * a)) - Math.cosh(x / a))];
}

function sag(cells, isFlat) {
  const columns = Math.max(2, cells / 5);
  const ease = (z) => ({ kind: 'ease', offset_m: [0, 0, z], begin_s: 0, end_s: 1 });
  const half = (1 - kSpan) / 2;
  const places = Array.from({ length: (cells + 1) * (columns + 1) }, (_, i) => {
    const [along, down] = catenaryPoint(kSpan, Math.floor(i / (columns + 1)) / cells);
    return [(0.2 * (i % (columns + 1))) / columns, 1 - down, along];
  });
  const scene = {
    name: 'sag',
    cloth: {
      sheet: {
        width_m: 0.2,
        height_m: 1,
        columns,
        rows: cells,
        origin_m: [0, 1, 0],
        warp_direction: [0, 0, 1],
        weft_direction: [1, 0, 0],
      },
    },
    fabric: { name: 'linen' },
    pins: ['upper_edge', 'lower_edge'].map((part, i) => ({
      part,
      ...(isFlat && { motion: ease(i ? -half : half) }),
    })),
    world: { air: {} },
    ...(!isFlat && { start: { positions_m: places } }),
    duration_s: isFlat ? 10 : 5,
  };
  const right = catenarySag(kSpan);
  const start = isFlat ? 'rails come together' : 'from rest';
  return {
    name: `sheet between rails, ${1e3 / cells} mm, ${start}`,
    source: 'catenary',
    of: (stepper) =>
      isFlat && explicitOnes.includes(stepper) ? kSwings : withStepper(scene, stepper),
    measures: [
      {
        of: 'sag',
        unit: 'm',
        right,
        tolerance: 0.02 * right,
        value: ({ positions }) => {
          const first = (cells / 2) * (columns + 1);
          return 1 - Math.min(...positions.slice(first, first + columns + 1).map(([, y]) => y));
        },
      },
    ],
  };
}

export const sags = () =>
  [20, 40].flatMap((cells) => [false, true].map((flat) => sag(cells, flat)));

/**
 * A limp curtain in steady wind U along z hangs in a plane, as drag and weight have one direction
 * all over it: across it W g sin a = 1/2 rho C_n U^2 cos a. It begins there and has to stay.
 */
export function curtains() {
  const wind = 1.4; // [m/s]
  const weight = kGravity * fabricNumber('fine cotton', 'areal_density_kg_per_m2');
  const angle = Math.atan((0.5 * kAirDensity * wind ** 2) / weight);
  return [5e-2, 2.5e-2].map((cell) => {
    const n = Math.round(0.5 / cell);
    return {
      name: `limp curtain in wind, ${1e3 * cell} mm`,
      source: 'plane in which drag and weight balance',
      of: (stepper) =>
        stepper === 'rk4' && cell < 5e-2
          ? 'two minutes, the same as explicit'
          : withStepper(
              {
                name: 'limp curtain',
                cloth: {
                  sheet: {
                    width_m: 0.5,
                    height_m: 0.5,
                    columns: n,
                    rows: n,
                    origin_m: [0, 1, 0],
                    warp_direction: [0, -Math.cos(angle), Math.sin(angle)],
                    weft_direction: [1, 0, 0],
                  },
                },
                fabric: { name: 'fine cotton' },
                model: { bending: 'none' },
                pins: [{ part: 'upper_edge' }],
                world: { air: { wind: { velocity_m_per_s: [0, 0, wind] } } },
                duration_s: 5,
              },
              stepper,
            ),
      measures: [
        {
          of: 'angle',
          unit: 'degrees',
          right: degrees(angle),
          tolerance: 1,
          value: ({ positions }) => {
            const last = positions.slice(-n - 1);
            const [y, z] = [1, 2].map((k) => mean(last.map((place) => place[k])));
            return degrees(Math.atan2(z, 1 - y));
          },
        },
        { of: 'speed', unit: 'm/s', right: 0, tolerance: 1e-3, value: ({ speed }) => speed },
      ],
    };
  });
}

/**
 * Air brakes by the square of the speed: with M u^2/2 the kinetic energy, M d(u^2/2)/dt is at most
 * -1/2 rho C A u^3, as the mean cube is no less than the cube of the mean square's root. That
 * leaves u = 2 W/(rho C t), whatever the start. C is the smaller coefficient, that along the
 * cloth, as folds swing in their plane too.
 */
export function flags() {
  const [kSeconds, kColumns, kRows] = [40, 12, 8];
  const kDragAlong = 0.1; // a scene's default
  const bound =
    (2 * fabricNumber('linen', 'areal_density_kg_per_m2')) / (kAirDensity * kDragAlong * kSeconds);
  const at = (i) => [i % (kColumns + 1), Math.floor(i / (kColumns + 1))];
  const all = Array.from({ length: (kColumns + 1) * (kRows + 1) }, (_, i) => at(i));
  const scene = {
    name: 'flag',
    cloth: {
      sheet: {
        width_m: 0.6,
        height_m: 0.4,
        columns: kColumns,
        rows: kRows,
        origin_m: [0, 1.4, 0],
        warp_direction: [0, -1, 0],
        weft_direction: [1, 0, 0],
      },
    },
    fabric: { name: 'linen' },
    pins: [{ part: 'left_edge' }],
    start: {
      positions_m: all.map(([c, r]) => [(0.6 * c) / kColumns, 1.4 - (0.4 * r) / kRows, 0]),
      velocities_m_per_s: all.map(([c]) => [0, 0, c === 0 ? 0 : 1]),
    },
    world: { air: {} },
    duration_s: kSeconds,
  };
  return [
    {
      name: 'flag pushed about its pole, after 40 s',
      source: 'bound 2 W/(rho C t) of the speed that air leaves',
      of: (stepper) =>
        stepper === 'rk4' ? 'a minute, the same as explicit' : withStepper(scene, stepper),
      measures: [
        {
          of: 'speed',
          unit: 'm/s',
          right: bound / 2,
          tolerance: bound / 2,
          value: ({ speed }) => speed,
        },
      ],
    },
  ];
}
