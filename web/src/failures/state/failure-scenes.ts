// Scenes of the view of failures, without a method: cloth of 24 by 24 cells and more, on which folds are seen.
import { type FabricQuantity, fabricNamed } from '../../shared/fabric/fabric-data';

type Vector = [number, number, number];

/** A scene as its file has it, without its method. */
export type Scene = Record<string, unknown>;

export const CELLS = 24;

const AIR = { density_kg_per_m3: 1.2, normal_coefficient: 1, tangent_coefficient: 0.1 };

/** A square of a metre that lies level. */
const LEVEL = {
  width_m: 1,
  height_m: 1,
  columns: CELLS,
  rows: CELLS,
  origin_m: [-0.5, 1.5, -0.5],
  warp_direction: [0, 0, 1],
  weft_direction: [1, 0, 0],
};

/** A sheet like that, upright. */
const UPRIGHT = { ...LEVEL, origin_m: [-0.5, 1.5, 0], warp_direction: [0, -1, 0] };

const COTTON = { name: 'fine cotton' };
const UPPER_EDGE = [{ part: 'upper_edge' }];

function ball(centre: Vector, radius: number) {
  return { sphere: { centre_m: centre, radius_m: radius } };
}

/** Let go from the horizontal; so soft that explicit steps need not be shorter than a millisecond. */
export const SOFT_SWING: Scene = {
  cloth: { sheet: LEVEL },
  fabric: {
    areal_density_kg_per_m2: 0.15,
    stretch_warp_n_per_m: 98,
    stretch_weft_n_per_m: 98,
    shear_n_per_m: 9.8,
  },
  pins: UPPER_EDGE,
  world: { air: AIR },
};

const STIFFNESSES: readonly FabricQuantity[] = [
  'stretch_warp_n_per_m',
  'stretch_weft_n_per_m',
  'shear_n_per_m',
  'bend_warp_n_m',
  'bend_weft_n_m',
];

/** A fabric with so many times its stiffness. */
function stiffer(name: string, times: number) {
  const own = fabricNamed(name);
  const overrides = Object.fromEntries(STIFFNESSES.map((key) => [key, times * own[key].value]));
  return { name, overrides };
}

/** Let go from the horizontal; a hundred times as stiff as canvas. */
export const STIFF_SWING: Scene = {
  cloth: { sheet: LEVEL },
  fabric: stiffer('canvas', 100),
  pins: UPPER_EDGE,
  world: { air: AIR },
};

/** Drawn together by nine hooks, forth and back in turn. */
export const CURTAIN: Scene = {
  cloth: { sheet: UPRIGHT },
  fabric: COTTON,
  pins: Array.from({ length: 9 }, (_, hook) => ({
    vertices: [(hook * CELLS) / 8],
    motion: {
      kind: 'ease',
      offset_m: [0.25 * (1 - hook / 4), 0, hook % 2 === 0 ? -0.05 : 0.05],
      begin_s: 0,
      end_s: 1.5,
    },
  })),
  world: { air: AIR },
};

/** Let fall on a ball. */
export const DRAPE: Scene = {
  cloth: { sheet: { ...LEVEL, origin_m: [-0.5, 0.87, -0.5] } },
  fabric: { name: 'linen' },
  world: { air: AIR, colliders: [ball([0, 0.6, 0], 0.25)] },
};

/** Thrown into the groove between two balls, with a wall behind it. */
export const GROOVE: Scene = {
  cloth: {
    sheet: { ...UPRIGHT, origin_m: [-0.5, 0.5, -1], initial_velocity_m_per_s: [0, 0, 30] },
  },
  fabric: COTTON,
  world: {
    colliders: [
      ball([-0.3, 0, 0], 0.3),
      ball([0.3, 0, 0], 0.3),
      { plane: { point_m: [0, 0, 0.2], normal: [0, 0, -1] } },
    ],
  },
};

/** A flag at its pole. */
export const FLAG: Scene = {
  cloth: {
    sheet: {
      ...UPRIGHT,
      width_m: 1.2,
      height_m: 0.8,
      columns: (3 * CELLS) / 2,
      origin_m: [-0.6, 1.6, 0],
    },
  },
  fabric: { name: 'silk' },
  pins: [{ part: 'left_edge' }],
  world: {
    air: { ...AIR, wind: { velocity_m_per_s: [14, 0, 3], gust_intensity: 0.2, seed: 1 } },
  },
};

/** A ball comes through the place where a curtain hangs. */
export const RUSHING_BALL: Scene = {
  cloth: { sheet: UPRIGHT },
  fabric: COTTON,
  pins: UPPER_EDGE,
  world: {
    air: AIR,
    colliders: [
      {
        ...ball([0, 0.9, -0.6], 0.15),
        motion: { kind: 'ease', offset_m: [0, 0, 1], begin_s: 0.1, end_s: 0.5 },
      },
    ],
  },
};

/** A lattice of particles that is drawn as the cloth that it is. */
interface Lattice {
  side: number;
  place(x: number, z: number): Vector;
  velocity?(at: Vector): Vector;
  /** Mass of the particle in row r and column c [kg]. */
  mass(row: number, column: number): number;
  /** Stiffness of the springs along threads and of those across cells [N/m]. */
  along: number;
  across: number;
  /** Damping of a spring over its stiffness [s]. */
  damping: number;
}

function lattice({ side, place, velocity, mass, along, across, damping }: Lattice): Scene {
  const width = CELLS + 1;
  const at = (row: number, column: number) => row * width + column;
  const cells = Array.from({ length: width * width }, (_, index) => ({
    row: Math.floor(index / width),
    column: index % width,
  }));
  const positions = cells.map(({ row, column }) =>
    place((column / CELLS - 0.5) * side, (row / CELLS - 0.5) * side),
  );
  const spring = (a: number, b: number, stiffness: number) => ({
    a,
    b,
    stiffness_n_per_m: stiffness,
    damping_n_s_per_m: damping * stiffness,
  });
  const springs = cells.flatMap(({ row, column }) => {
    const [isRight, isDown] = [column < CELLS, row < CELLS];
    const own = at(row, column);
    return [
      ...(isRight ? [spring(own, own + 1, along)] : []),
      ...(isDown ? [spring(own, own + width, along)] : []),
      ...(isRight && isDown
        ? [spring(own, own + width + 1, across), spring(own + 1, own + width, across)]
        : []),
    ];
  });
  const triangles = cells.flatMap(({ row, column }) => {
    if (row === CELLS || column === CELLS) return [];
    const own = at(row, column);
    return [
      [own, own + width, own + 1],
      [own + 1, own + width, own + width + 1],
    ];
  });
  return {
    particles: {
      positions_m: positions,
      ...(velocity && { velocities_m_per_s: positions.map(velocity) }),
      masses_kg: cells.map(({ row, column }) => mass(row, column)),
      springs,
      triangles,
    },
  };
}

/** Turns in free space, without weight and air. */
export const TUMBLING: Scene = {
  cloth: lattice({
    side: 0.8,
    place: (x, z) => [x, 0.02 * Math.sin(9 * x + 5 * z), z],
    velocity: ([x, y, z]) => [3 * z - y, x - 0.5 * z, 0.5 * y - 3 * x],
    mass: () => 4e-4,
    along: 4,
    across: 0.4,
    damping: 2e-4,
  }),
  world: { gravity_m_per_s2: [0, 0, 0] },
};

/** The vertex in the middle. */
export const MIDDLE = ((CELLS + 1) ** 2 - 1) / 2;

/** A net that is held all round, with a bead in its middle. */
export const BEAD: Scene = {
  cloth: lattice({
    side: 1,
    place: (x, z) => [x, 1.5, z],
    mass: (row, column) => (row === CELLS / 2 && column === CELLS / 2 ? 1 : 2.5e-5),
    along: 1000,
    across: 100,
    damping: 5e-4,
  }),
  pins: [
    {
      vertices: Array.from({ length: (CELLS + 1) ** 2 }, (_, vertex) => vertex).filter((vertex) => {
        const [row, column] = [Math.floor(vertex / (CELLS + 1)), vertex % (CELLS + 1)];
        return row % CELLS === 0 || column % CELLS === 0;
      }),
    },
  ],
};
