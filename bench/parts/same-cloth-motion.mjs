// Cloth that falls, slides or is gripped: what becomes of it is known.
import {
  fabricNumber,
  kAirDensity,
  kGravity,
  lyingSheet,
  meanOf,
  stretchMeasure,
  withStepper,
} from './same-cloth-scenes.mjs';

const kFrame = 1 / 60; // [s], the longest substep of any stepper at its defaults

export function terminals() {
  const kSeconds = 3;
  return ['chiffon', 'silk', 'linen', 'coarse cotton (denim)', 'wool'].map((fabric) => {
    const last = Math.sqrt(
      (2 * kGravity * fabricNumber(fabric, 'areal_density_kg_per_m2')) / kAirDensity,
    );
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
  const kHold = fabricNumber('fine cotton', 'thickness_m') / 2; // vertices off a plane
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

/**
 * A strip between jaws that close on half of its thickness, and one between two balls that are
 * further apart than it is thick.
 */
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
