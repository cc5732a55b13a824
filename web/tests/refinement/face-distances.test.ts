// Distances of faces from the fine cloth against the module's, which knows only their mean.
import { beforeAll, describe, expect, it } from 'vitest';
import type { RefinementModule } from '../../src/refinement/bindings/refinement-module';
import { createFaceDistances } from '../../src/refinement/state/face-distances';
import { countFaces, faceAt, type PlanFile } from '../../src/refinement/state/plan-file';
import { fabricsText } from '../../src/shared/fabric/fabric-data';
import { loadModule } from '../support/built-module';

let module: RefinementModule;
beforeAll(async () => {
  module = await loadModule();
});

const CELLS = 6;

function sheet(refinement: object, columns = CELLS): object {
  const size = { width_m: 1, height_m: 1, columns, rows: CELLS, origin_m: [-0.5, 1.5, 0] };
  const directions = { warp_direction: [0, -0.8, 0.6], weft_direction: [1, 0, 0] };
  return {
    name: 'sheet',
    cloth: { sheet: { ...size, ...directions } },
    fabric: { name: 'fine cotton' },
    pins: [{ part: 'upper_edge' }],
    refinement,
  };
}

/** A plan that refines along one side. */
function sidePlan(): PlanFile {
  const study = new module.ExampleStudy(fabricsText);
  study.open(JSON.stringify(sheet({ level: 2 })), {});
  const features = Float64Array.from({ length: 2 * 625 }, (_, k) =>
    Math.floor(k / 2) % (CELLS + 1) < 2 ? 8 : 1,
  );
  study.sort('bent', features, 3);
  const { plan } = JSON.parse(study.plan('{"demand": 3}'));
  study.delete();
  return plan;
}

function loaded(refinement: object, columns = CELLS) {
  const run = new module.GarmentRun(fabricsText);
  const answer = JSON.parse(run.load(JSON.stringify(sheet(refinement, columns)), {}));
  expect(answer).toMatchObject({ ok: true });
  run.holdAgainst(JSON.stringify(sheet({ level: 2 })), {});
  return { run, mesh: { faces: run.faces().slice(), parents: run.parents().slice() } };
}

/** A sheet of the fine mesh with waves of about its cells' size. */
function waves(places: Float32Array): Float32Array {
  return places.map((value, k) => {
    const [x, y] = [places[k - (k % 3)] ?? 0, places[k - (k % 3) + 1] ?? 0];
    return k % 3 === 2 ? value + 0.05 * Math.sin(17 * x + 1) * Math.cos(11 * y) : value;
  });
}

describe('distances of faces', () => {
  it.each([
    ['a coarse mesh', () => ({ level: 0 })],
    ['a planned mesh', () => ({ plan: sidePlan() })],
  ])('of %s have the mean square that the module finds', (_, refinement) => {
    const fine = loaded({ level: 2 });
    const { run, mesh } = loaded(refinement());
    const places = waves(fine.run.positions().slice());
    run.step(5);
    const own = run.positions().slice();
    const distances = createFaceDistances(mesh, fine.mesh)?.(own, places);
    expect(distances?.length).toBe(countFaces(mesh.faces));
    let [sum, area] = [0, 0];
    distances?.forEach((distance, index) => {
      const share = 4 ** -faceAt(mesh.faces, index).level;
      sum += share * distance ** 2;
      area += share;
    });
    const { rms_m: rms } = JSON.parse(run.compare(places));
    expect(rms).toBeGreaterThan(0.005);
    expect(Math.sqrt(sum / area) / rms).toBeCloseTo(1, 4); // places are floats
    run.delete();
    fine.run.delete();
  });

  it('are none where the fine mesh does not refine the other one', () => {
    const fine = loaded({ level: 2 });
    const other = loaded({ level: 0 }, CELLS + 1);
    expect(createFaceDistances(other.mesh, fine.mesh)).toBeNull();
    other.run.delete();
    fine.run.delete();
  });
});
