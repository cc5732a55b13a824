// Small cloth that must not stretch: squares of any cells and fabric, and a mesh with slivers.
import { explicitOnes, runCases, worstOf } from './same-cloth-runs.mjs';
import {
  fabricNames,
  fabricNumber,
  kGravity,
  lyingSheet,
  meanOf,
  stretchMeasure,
  withStepper,
} from './same-cloth-scenes.mjs';

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

const kFinest = { explicit: 5e-3, rk4: 10e-3 }; // cells [m]

/** A square swings down from its upper edge; weight stretches it by W g L/K at rest. */
function swatch(fabric, cells, cell, seconds, name) {
  const size = cells * cell;
  const stiffness = Math.min(
    ...['stretch_warp_n_per_m', 'stretch_weft_n_per_m'].map((key) => fabricNumber(fabric, key)),
  );
  const kSwing = 3; // weights that a swing from the horizontal hangs on its pins at most
  const explained =
    (kSwing * kGravity * fabricNumber(fabric, 'areal_density_kg_per_m2') * size) / stiffness;
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
    of: (stepper) =>
      cell < kFinest[stepper] ? 'minutes of small substeps' : withStepper(scene, stepper),
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
