// Drape of discs of fabric at the defaults of a scene, against drape coefficients that were
// measured: a disc of 15 cm lies with 9 cm on a support, and its shadow tells how far it hangs.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

import { fabricsText } from './assets.mjs';
import { tell } from './bench-options.mjs';
import { atMost, largest, table } from './bench-rows.mjs';
import { inFolder, ran } from './command.mjs';

const kRadius = 0.15; // [m]
const kSupport = 0.09; // [m]
const kCells = [15e-3, 7.5e-3]; // [m]
const kPixel = 0.5e-3; // [m]
const kKappa0 = 30; // [1/m], by which a scene adds the hysteresis at rest
const kDampingRatio = 0.08; // fine cotton's
const kMostPoints = 18; // fine cotton was 19 off as an isotropic sheet

/** A disc in the plane y = 1 m of rings of triangles; what the support holds is a part of its own. */
function discMesh(cell) {
  const positions = [[0, 1, 0]];
  const rings = [[0]];
  for (let k = 1; k <= Math.round(kRadius / cell); ++k)
    rings.push(
      Array.from({ length: 6 * k }, (_, j) => {
        const angle = (Math.PI * j) / (3 * k);
        return positions.push([k * cell * Math.cos(angle), 1, k * cell * Math.sin(angle)]) - 1;
      }),
    );
  const triangles = rings.slice(1).flatMap((outer, inner) => {
    const at = (ring, index) => ring[index % ring.length];
    return Array.from({ length: 6 }, (_, s) => s).flatMap((s) =>
      Array.from({ length: inner + 1 }, (_, j) => j).flatMap((j) => {
        const [a, b] = [0, 1].map((by) => at(outer, s * (inner + 1) + j + by));
        const c = at(rings[inner], s * inner + j);
        const next = at(rings[inner], s * inner + j + 1);
        return j < inner
          ? [
              [a, c, b],
              [b, c, next],
            ]
          : [[a, c, b]];
      }),
    );
  });
  return { positions_m: positions, triangles, warp_direction: [1, 0, 0] };
}

/** Area of the shadow from above [m^2], of triangles at such places. */
function shadow(places, triangles) {
  const n = Math.ceil((2.2 * kRadius) / kPixel);
  const covered = new Uint8Array(n * n);
  const inPixels = (metres) => metres / kPixel + n / 2;
  for (const triangle of triangles) {
    const corners = triangle.map((i) => [inPixels(places[i][0]), inPixels(places[i][2])]);
    const rows = corners.map(([, z]) => z);
    for (let row = Math.floor(Math.min(...rows)); row <= Math.max(...rows); ++row) {
      const middle = row + 0.5;
      const ends = corners.flatMap(([ax, az], i) => {
        const [bx, bz] = corners[(i + 1) % 3];
        return az <= middle !== bz <= middle ? [ax + ((middle - az) / (bz - az)) * (bx - ax)] : [];
      });
      const [begin, end] = [Math.min(...ends), Math.max(...ends)].map((x) => Math.ceil(x - 0.5));
      if (ends.length > 0) covered.fill(1, row * n + begin, row * n + end);
    }
  }
  return covered.reduce((sum, one) => sum + one, 0) * kPixel ** 2;
}

/** Share of the overhanging ring that is in the shadow [%]: the drape coefficient. */
function drapeOf(scene) {
  return inFolder((folder) => {
    const file = join(folder, 'state.json');
    const { stdout } = ran(['run', scene, '--json', '--state', file], 'pipe');
    const { status, warnings } = JSON.parse(stdout);
    const { positions_m } = JSON.parse(readFileSync(file, 'utf8'));
    const ring = shadow(positions_m, scene.cloth.mesh.triangles) - Math.PI * kSupport ** 2;
    const whole = Math.PI * (kRadius ** 2 - kSupport ** 2);
    return { status, told: warnings.map(({ kind }) => kind), percent: (100 * ring) / whole };
  });
}

function sceneOf(fabric, cell) {
  const mesh = discMesh(cell);
  const isHeld = ([x, , z]) => Math.hypot(x, z) <= kSupport + 1e-9;
  const held = mesh.positions_m.flatMap((place, vertex) => (isHeld(place) ? [vertex] : []));
  return {
    name: 'drape',
    cloth: { mesh },
    fabric,
    pins: [{ vertices: held }],
    world: { air: {} },
    method: { stepper: 'implicit' },
    duration_s: 3,
  };
}

const materials = () => JSON.parse(fabricsText()).reference_materials;

/** Fibres of the four fabrics of which bending and drape were measured together (MATSU15). */
const kFibres = {
  'cotton broadcloth, plain': 'cotton',
  'wool tropical, plain': 'wool',
  'polyester tropical': 'polyester',
  'polyester faille': 'polyester',
};

/** Fabrics of these names, with threads and shear of a woven of the same fibre (PENAVA14). */
const measuredTogether = () =>
  Object.entries(kFibres).map(([name, fibre]) => {
    const own = materials().find((one) => one.source === 'MATSU15' && one.name === name);
    const woven = materials().find((one) => one.source === 'PENAVA14' && one.name === fibre);
    const bend = own.B + own.twoHB / 2 / kKappa0;
    const fabric = {
      areal_density_kg_per_m2: own.areal_density_kg_per_m2,
      stretch_warp_n_per_m: woven.stretch_1_n_per_m,
      stretch_weft_n_per_m: woven.stretch_2_n_per_m,
      shear_n_per_m: woven.shear_n_per_m,
      bend_warp_n_m: bend,
      bend_weft_n_m: bend,
      damping_ratio: kDampingRatio,
    };
    return { name, fabric, measured: own.drape_coefficient, source: own.source };
  });

const ofLibrary = () =>
  JSON.parse(fabricsText()).fabrics.map(({ name_en, drape_coefficient_percent: known }) => ({
    name: name_en,
    fabric: { name: name_en },
    measured: known.value,
    isEstimate: known.confidence === 'estimated',
    range: known.range,
    source: known.source.join(' '),
  }));

export function drape() {
  const rows = [...measuredTogether(), ...ofLibrary()].flatMap(({ fabric, ...of }) =>
    kCells.map((cell) => {
      tell(`${of.name}, cells of ${1e3 * cell} mm`);
      return { case: 'drape', cell_m: cell, ...of, ...drapeOf(sceneOf(fabric, cell)) };
    }),
  );
  const off = ({ percent, measured }) => percent - measured;
  const columns = {
    fabric: 'name',
    'cell mm': (row) => 1e3 * row.cell_m,
    'drape %': 'percent',
    measured: ({ measured, isEstimate }) => `${measured}${isEstimate ? ' (estimate)' : ''}`,
    range: ({ range }) => range?.join(' to ') ?? '',
    'points above': off,
    told: ({ told }) => told.join(' '),
    source: 'source',
  };
  const measured = rows.filter(({ isEstimate }) => !isEstimate);
  const most = largest(measured.map((row) => Math.abs(off(row))));
  return {
    rows,
    goals: [atMost('drape_off_measured_points', most, kMostPoints, measured)],
    text: `\n\n${table(rows, columns)}`,
  };
}
