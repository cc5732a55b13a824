// A strip clamped at one end, at rest under its weight, on several triangulations, against the
// heavy elastica. Its first two rows of vertices are held, the clamp is the second of them.
import { atMost, mean, measure, table } from './bench-rows.mjs';
import { nativeRun, reference } from './command.mjs';
import { kStep } from './sheets.mjs';

const kLength = 0.2; // [m], from the clamp on
const kEdges = 40; // edges along it
const kColumns = 10;
const kArealDensity = 0.114; // [kg/m^2]
const kGravity = 9.81; // [m/s^2], a scene's default
const kStretch = 4500; // [N/m]
const kLoads = [1, 10, 100]; // rho g L^3/B
const kPromised = ['one_way', 'alternating', 'irregular'];
const kLargestPercent = 2;

export const triangulations = [...kPromised, 'crossed'];

/** SplitMix64, as the core's: numbers in [0, 1). */
function random(seed) {
  const wrap = (value) => BigInt.asUintN(64, value);
  let state = BigInt(seed);
  return () => {
    state = wrap(state + 0x9e3779b97f4a7c15n);
    let z = wrap((state ^ (state >> 30n)) * 0xbf58476d1ce4e5b9n);
    z = wrap((z ^ (z >> 27n)) * 0x94d049bb133111ebn);
    return Number((z ^ (z >> 31n)) >> 11n) / 2 ** 53;
  };
}

/** The four corners of a cell as two triangles, cut from a to d or from b to c. */
const cut = (a, b, c, d, isFromAToD) => [
  [a, b, isFromAToD ? d : c],
  [isFromAToD ? a : b, d, c],
];

/**
 * A flat strip along x, its row 1 at x = 0. Vertex r (columns + 1) + c lies in row r; `crossed` has
 * the middles of its cells behind them.
 *
 * - one_way, alternating: squares cut along one diagonal
 * - irregular: cut along either, at random, and every vertex inside, behind the clamp, moved by up
 *   to a fifth of an edge each way
 * - crossed: cut along both
 */
export function strip(triangulation, edges = kEdges, columns = kColumns) {
  const kShift = 0.2; // share of an edge: triangles keep a sixth of their height at least
  const edge = kLength / edges;
  const uniform = random(7);
  const line = columns + 1;
  const positions = [];
  const triangles = [];
  const isMoved = (r, c) =>
    triangulation === 'irregular' && r > 1 && r <= edges && c > 0 && c < columns;
  for (let r = 0; r <= edges + 1; ++r) {
    for (let c = 0; c <= columns; ++c) {
      const [dx, dz] = [0, 0].map(() => (isMoved(r, c) ? kShift * (2 * uniform() - 1) : 0));
      positions.push([(r - 1 + dx) * edge, 0, (c + dz) * edge]);
    }
  }
  const isFromAToD = {
    one_way: () => false,
    alternating: (r, c) => (r + c) % 2 === 0,
    irregular: () => uniform() < 0.5,
  }[triangulation];
  for (let r = 0; r <= edges; ++r) {
    for (let c = 0; c < columns; ++c) {
      const corner = r * line + c;
      const [a, b, d, e] = [corner, corner + 1, corner + line, corner + line + 1];
      if (triangulation === 'crossed') {
        const middle = positions.length;
        positions.push([(r - 0.5) * edge, 0, (c + 0.5) * edge]);
        triangles.push([a, b, middle], [b, e, middle], [e, d, middle], [d, a, middle]);
      } else {
        triangles.push(...cut(a, b, d, e, isFromAToD(r, c)));
      }
    }
  }
  return { positions, triangles, line, rows: edges + 2 };
}

function scene(load, bending, name, cloth, line) {
  const rigidity = (kArealDensity * kGravity * kLength ** 3) / load;
  return {
    name,
    cloth,
    fabric: {
      areal_density_kg_per_m2: kArealDensity,
      stretch_warp_n_per_m: kStretch,
      stretch_weft_n_per_m: kStretch,
      shear_n_per_m: kStretch / 3, // an isotropic sheet
      bend_warp_n_m: rigidity,
      bend_weft_n_m: rigidity,
    },
    model: { elasticity: 'membrane', bending, ...(bending === 'fitted' && { torsion: 1 }) },
    pins: [{ vertices: [...Array(2 * line).keys()] }],
    method: { stepper: 'newton', rule: 'equilibrium', step_s: kStep }, // a length of no effect
    duration_s: kStep,
  };
}

function meshScene(load, bending, triangulation) {
  const { positions, triangles, line } = strip(triangulation);
  const mesh = { positions_m: positions, triangles, warp_direction: [1, 0, 0] };
  return scene(load, bending, `cantilever, load ${load}`, { mesh }, line);
}

/** The elastica at the vertices of the strip's rows and columns. */
function elastica(load) {
  const edge = kLength / kEdges;
  const sheet = {
    width_m: kColumns * edge,
    height_m: kLength + edge,
    columns: kColumns,
    rows: kEdges + 1,
    origin_m: [-edge, 0, 0],
    warp_direction: [1, 0, 0],
    weft_direction: [0, 0, 1],
  };
  const line = kColumns + 1;
  return reference(scene(load, 'fitted', 'elastica', { sheet }, line), 'closed_form', [kStep]);
}

/** [extent, height] of each vertex of the last row, from the clamp [m]. */
function tips(positions) {
  const first = (kEdges + 1) * (kColumns + 1);
  return Array.from({ length: kColumns + 1 }, (_, c) => {
    const x = 3 * (first + c);
    return [positions[x], -positions[x + 1]];
  });
}

/**
 * How far the tip is from the elastica's, in percent: the worst vertex of the last row, of the way
 * that weight moved the elastica's tip; and the mean's extent and height, of their own and of the
 * strip's length.
 */
export function tipErrors(positions, elasticaPositions, length = kLength) {
  const found = tips(positions);
  const [right] = tips(elasticaPositions);
  const way = Math.hypot(right[0] - length, right[1]);
  const distances = found.map((tip) => Math.hypot(tip[0] - right[0], tip[1] - right[1]));
  const [extent, height] = [0, 1].map((k) => mean(found.map((tip) => tip[k])) - right[k]);
  return {
    percent: (100 * Math.max(...distances)) / way,
    extent_percent: (100 * extent) / right[0],
    height_percent: (100 * height) / right[1],
    extent_percent_of_length: (100 * extent) / length,
    height_percent_of_length: (100 * height) / length,
  };
}

/** A run to rest is one step: that step is on the clock, with all that is built for it. */
function contestant(load, bending, triangulation, shapes) {
  const built = meshScene(load, bending, triangulation);
  const label = `${built.name}, ${triangulation}, ${bending}`;
  return {
    label,
    scene: built.name,
    method: built.method,
    begin: async (times) => {
      const run = nativeRun(built, 2, times);
      if (times.length) shapes.set(label, run.samples[0]?.positions_m);
      return { finish: async () => ({ ...run, ms: [run.first_ms] }) };
    },
  };
}

async function rowsAtLoad(load, repeat) {
  const against = elastica(load);
  const [{ positions_m: right }] = against.samples;
  const vertices = right.length / 3;
  const isTip = Array.from({ length: vertices }, (_, i) => Number(i >= vertices - kColumns - 1));
  const shapes = new Map();
  const contestants = ['fitted', 'hinge'].flatMap((bending) =>
    triangulations.map((triangulation) => contestant(load, bending, triangulation, shapes)),
  );
  const options = { repeat, times: [kStep], against, masses: isTip, frames: 1 };
  const rows = await measure(contestants, options);
  return rows.map(({ ms_per_frame, ms_per_simulated_second, position_errors_m, ...row }) => ({
    ...row,
    ms_to_rest: ms_per_frame,
    tip: tipErrors(shapes.get(row.label) ?? [], right),
  }));
}

function tipTable(rows) {
  const columns = {
    contestant: 'label',
    vertices: 'n_vertices',
    'ms to rest': 'ms_to_rest',
    spread: 'spread_ms',
    'tip, % of its way': (row) => row.tip.percent,
    'extent %': (row) => row.tip.extent_percent,
    'height %': (row) => row.tip.height_percent,
    'extent, % of L': (row) => row.tip.extent_percent_of_length,
    'height, % of L': (row) => row.tip.height_percent_of_length,
    residual: 'residual',
    status: 'status',
  };
  return `errors against ${rows[0].reference.description}\n\n${table(rows, columns)}`;
}

/** Fitted bending, with a bound on the tip's error, and hinges beside it. */
export async function cantilever({ repeat }) {
  const rows = [];
  const goals = [];
  for (const load of kLoads) {
    const found = await rowsAtLoad(load, repeat);
    rows.push(...found);
    for (const [i, name] of kPromised.entries()) {
      const { percent } = found[i].tip;
      const title = `cantilever_${name}_load_${load}_tip_percent`;
      goals.push(atMost(title, percent, kLargestPercent, [found[i]]));
    }
  }
  return { rows, goals, text: tipTable(rows) };
}
