// Cloth that falls, slides, is gripped, or is small: what becomes of it is known.
import { explicitOnes, runCases, worstOf } from './same-cloth-runs.mjs';
import { kAirDensity, fabricNames, fabricNumber, kGravity, withStepper } from './same-cloth-rest.mjs';

const kFrame = 1 / 60; // [s], the longest substep of any stepper at its defaults
const meanOf = (places) =>
  [0, 1, 2].map((k) => places.reduce((sum, place) => sum + place[k], 0) / places.length);
const weightOf = (fabric) => fabricNumber(fabric, 'areal_density_kg_per_m2');

/** A square that lies: warp along z, weft along x, its first corner at `origin`. */
const lyingSheet = (n, size, origin_m) => ({
  sheet: {
    width_m: size,
    height_m: size,
    columns: n,
    rows: n,
    origin_m,
    warp_direction: [0, 0, 1],
    weft_direction: [1, 0, 0],
  },
});

export function terminals() {
  const kSeconds = 3;
  return ['chiffon', 'silk', 'linen', 'coarse cotton (denim)', 'wool'].map((fabric) => {
    const last = Math.sqrt((2 * kGravity * weightOf(fabric)) / kAirDensity);
    const right = last * Math.tanh((kGravity * kSeconds) / last);
    const scene = {
      name: 'terminal speed',
      cloth: lyingSheet(10, 0.4, [0, 50, 0]),
      fabric: { name: fabric },
      world: { air: {} },
      duration_s: kSeconds,
    };
    return {
      name: `${fabric} falls flat`,
      source: 'sqrt(2 g W/rho) tanh(g t/sqrt(2 g W/rho))',
      of: (stepper) => withStepper(scene, stepper),
      measures: [
        {
          of: 'speed',
          unit: 'm/s',
          right,
          tolerance: 0.01 * right,
          value: ({ velocities }) => -meanOf(velocities)[1],
        },
      ],
    };
  });
}

/**
 * Cloth on a plane of 20 degrees for a second: g t (sin a - mu cos a), or rest. Leaning are the
 * plane's normal, or gravity over a plane that lies.
 */
export function inclines() {
  const kAngle = (20 * Math.PI) / 180;
  const kHold = fabricNumber('fine cotton', 'thickness_m') / 2; // of a vertex off a plane
  const [sine, cosine] = [Math.sin(kAngle), Math.cos(kAngle)];
  const leanings = {
    normal: {
      origin: [kHold * sine, kHold * cosine, 0],
      weft: [cosine, -sine, 0],
      plane: { normal: [sine, cosine, 0] },
    },
    gravity: {
      origin: [0, kHold, 0],
      weft: [1, 0, 0],
      plane: {},
      gravity: [kGravity * sine, -kGravity * cosine, 0],
    },
  };
  return [0, 1e-9, 0.2, 1].flatMap((mu) =>
    Object.entries(leanings).map(([leaning, { origin, weft, plane, gravity }]) => {
      const right = Math.max(0, kGravity * (sine - mu * cosine));
      const cloth = lyingSheet(8, 0.2, origin);
      cloth.sheet.weft_direction = weft;
      const world = { colliders: [{ plane, friction: mu }] };
      if (gravity) world.gravity_m_per_s2 = gravity;
      const scene = {
        name: 'incline',
        cloth,
        fabric: { name: 'fine cotton' },
        world,
        duration_s: 1,
      };
      return {
        name: `incline by ${leaning}, mu ${mu}`,
        source: 'g t (sin a - mu cos a)',
        of: (stepper) => withStepper(scene, stepper),
        measures: [
          {
            of: 'speed',
            unit: 'm/s',
            right,
            tolerance: right ? (mu < 0.1 ? 1e-3 : 1e-2) * right : 1e-9,
            value: ({ speed }) => speed,
          },
        ],
      };
    }),
  );
}

/** A sheet that is thrown along the floor, or lies down on a belt. */
export function slides() {
  const kMu = 0.3;
  const kSeconds = 0.8;
  const kCells = 8;
  const hold = fabricNumber('fine cotton', 'thickness_m') / 2;
  const cloth = lyingSheet(kCells, 0.2, [0, hold, 0]);
  const places = Array.from({ length: (kCells + 1) ** 2 }, (_, i) => [
    (0.2 * (i % (kCells + 1))) / kCells,
    hold,
    (0.2 * Math.floor(i / (kCells + 1))) / kCells,
  ]);
  const scene = (collider, velocity) => ({
    name: 'slide',
    cloth,
    fabric: { name: 'fine cotton' },
    start: { positions_m: places, velocities_m_per_s: places.map(() => velocity) },
    world: { colliders: [{ plane: {}, friction: kMu, ...collider }] },
    duration_s: kSeconds,
  });
  const wayOf = ({ positions }) => meanOf(positions).map((x, k) => x - meanOf(places)[k]);
  const brake = kMu * kGravity;
  const [thrown, belt] = [[0.8, 0, 0.6], 0.5]; // [m/s]
  const speed = Math.hypot(...thrown);
  const stops = speed ** 2 / (2 * brake);
  const rides = belt * kSeconds - belt ** 2 / (2 * brake);
  const moving = {
    motion: { kind: 'move', offset_m: [belt * kSeconds, 0, 0], begin_s: 0, end_s: kSeconds },
  };
  return [
    {
      name: 'slide to rest',
      source: 'v^2/(2 mu g)',
      of: (stepper) => withStepper(scene({}, thrown), stepper),
      measures: [
        {
          of: 'way, off by',
          unit: 'm',
          right: 0,
          tolerance: 0.005 * stops + (kFrame * speed) / 2, // an Euler step ends behind by h v/2
          value: (end) => {
            const way = wayOf(end);
            return Math.hypot(...way.map((x, k) => x - (stops * thrown[k]) / speed));
          },
        },
        { of: 'speed', unit: 'm/s', right: 0, tolerance: 1e-9, value: (end) => end.speed },
      ],
    },
    {
      name: 'belt',
      source: 'v t - v^2/(2 mu g)',
      of: (stepper) => withStepper(scene(moving, [0, 0, 0]), stepper),
      measures: [
        {
          of: 'way',
          unit: 'm',
          right: rides,
          tolerance: 0.005 * rides + (kFrame * belt) / 2,
          value: (end) => wayOf(end)[0],
        },
        { of: 'speed', unit: 'm/s', right: belt, tolerance: 1e-6, value: (end) => end.speed },
      ],
    },
  ];
}

/** A strip between jaws that close on half its thickness and keep it; and between two balls further apart than that. */
export function grips() {
  const thickness = fabricNumber('linen', 'thickness_m');
  const strip = (columns, rows, cell, height) => ({
    sheet: {
      width_m: columns * cell,
      height_m: rows * cell,
      columns,
      rows,
      origin_m: [0, height, (-columns * cell) / 2],
      warp_direction: [0, -1, 0],
      weft_direction: [0, 0, 1],
    },
  });
  const jaws = [-1, 1].map((side) => ({
    plane: { normal: [-side, 0, 0], point_m: [side * thickness, 0, 0] },
    friction: 1,
    motion: {
      kind: 'ease',
      offset_m: [-side * 0.75 * thickness, 0, 0],
      begin_s: 0,
      end_s: 0.02,
    },
  }));
  const kHeld = 0.5; // [s]
  const held = {
    name: 'grip',
    cloth: strip(4, 10, 0.01, 0.04),
    fabric: { name: 'linen' },
    world: { air: {}, colliders: jaws },
    duration_s: kHeld,
  };
  const kRadius = 0.1;
  const kFall = 0.4; // [s]
  const gap = 8 * thickness;
  const fall = (kGravity * kFall ** 2) / 2;
  const between = [1e-2, 5e-2].map((cell) => {
    const columns = Math.max(2, 0.1 / cell);
    const balls = [-1, 1].map((side) => ({
      sphere: { centre_m: [side * (kRadius + gap / 2), 0, 0], radius_m: kRadius },
      friction: 0,
    }));
    const scene = {
      name: 'gap',
      cloth: strip(columns, 0.2 / cell, cell, 0.35),
      fabric: { name: 'linen' },
      world: { colliders: balls },
      duration_s: kFall,
    };
    return {
      name: `gap of eight thicknesses between smooth balls, ${1e3 * cell} mm`,
      source: 'free fall',
      of: (stepper) => withStepper(scene, stepper),
      measures: [
        {
          of: 'fall',
          unit: 'm',
          right: fall,
          tolerance: 0.005 * fall + (kFrame * kGravity * kFall) / 2,
          value: ({ positions }) => 0.25 - meanOf(positions)[1],
        },
        stretchMeasure(0.002),
      ],
    };
  });
  return [
    {
      name: 'grip of two jaws, mu 1',
      source: 'it holds: less than it falls while they close',
      of: (stepper) => withStepper(held, stepper),
      measures: [
        {
          of: 'slip',
          unit: 'm',
          right: 0,
          tolerance: 0.003,
          value: ({ positions }) => -0.01 - meanOf(positions)[1],
        },
        stretchMeasure(0.01),
      ],
    },
    ...between,
  ];
}

/** The largest stretch of an edge in the whole run, in shares of its length. */
function stretchMeasure(most) {
  return {
    of: 'largest stretch',
    unit: '',
    right: 0,
    tolerance: most,
    value: ({ metrics }) => metrics.largest_stretch,
  };
}

/**
 * A square of 12 cells whose upper and left border have further vertices 10 um inside of the
 * middles of their sides: triangles a 300th as high as they are long.
 */
export function sliverMesh() {
  const [kCells, kCell, kInside] = [12, 6e-3, 1e-5];
  const line = kCells + 1;
  const positions = [];
  const triangles = [];
  for (let i = 0; i < line ** 2; ++i)
    positions.push([kCell * (i % line), 1, kCell * Math.floor(i / line)]);
  for (let r = 0; r < kCells; ++r)
    for (let c = 0; c < kCells; ++c) {
      const a = r * line + c;
      triangles.push([a, a + line, a + line + 1], [a, a + line + 1, a + 1]);
    }
  for (let c = 0; c < kCells; c += 3) {
    const [a, b] = [c, c + 1];
    const middle = positions.push([kCell * (c + 0.7), 1, kInside]) - 1;
    const across = triangles.findIndex((of) => of.includes(a) && of.includes(b));
    const [inner] = triangles[across].filter((i) => i !== a && i !== b);
    triangles[across] = [a, middle, b];
    triangles.push([a, inner, middle], [middle, inner, b]);
  }
  return { positions_m: positions, triangles, warp_direction: [0, 0, 1] };
}

export function slivers() {
  const kSeconds = 0.2;
  const scene = {
    name: 'slivers',
    cloth: { mesh: sliverMesh() },
    fabric: { name: 'fine cotton' },
    duration_s: kSeconds,
  };
  return [
    {
      name: 'flat sheet with slivers falls',
      source: 'free fall: nothing stretches, nothing drifts',
      of: (stepper) =>
        explicitOnes.includes(stepper)
          ? 'slivers ask for more substeps than a second has'
          : withStepper(scene, stepper),
      measures: [
        stretchMeasure(0.002),
        {
          of: 'speed',
          unit: 'm/s',
          right: kGravity * kSeconds,
          tolerance: 1e-3 * kGravity * kSeconds,
          value: ({ velocities }) => -meanOf(velocities)[1],
        },
      ],
    },
  ];
}

/** A square of so many cells swings down from its upper edge; weight stretches it by W g L/K at rest. */
function swatch(fabric, cells, cell, seconds, name) {
  const size = cells * cell;
  const stiffness = Math.min(
    ...['stretch_warp_n_per_m', 'stretch_weft_n_per_m'].map((key) => fabricNumber(fabric, key)),
  );
  const kSwing = 3; // weights that a swing from the horizontal hangs on its pins at most
  const explained = (kSwing * kGravity * weightOf(fabric) * size) / stiffness;
  const scene = {
    name: 'swatch',
    cloth: lyingSheet(cells, size, [0, 1, 0]),
    fabric: { name: fabric },
    pins: [{ part: 'upper_edge' }],
    duration_s: seconds,
  };
  return {
    name,
    source: '0.2 % beside three times what weight explains',
    of: (stepper) => withStepper(scene, stepper),
    measures: [stretchMeasure(0.002 + explained)],
  };
}

/** Rows of the swatch: one for each size of cells and stepper, which is the worst of 15 fabrics. */
export function swatchRows(names) {
  const kCells = 12;
  return [1, 2.5, 5, 10, 25, 50].flatMap((millimetres) => {
    const name = `swatch of cells of ${millimetres} mm, worst of 15 fabrics`;
    return names.map((stepper) => {
      const rows = fabricNames().flatMap((fabric) =>
        runCases([swatch(fabric, kCells, 1e-3 * millimetres, 0.25, name)], [stepper]).map(
          (row) => ({ ...row, fabric }),
        ),
      );
      return worstOf(rows);
    });
  });
}

/** `02` of the reported cases: 60 x 60 cells of 5 mm. */
export const fineSwatches = () => [
  swatch('linen', 60, 5e-3, 0.5, 'swatch of 60 x 60 cells of 5 mm, linen'),
];
