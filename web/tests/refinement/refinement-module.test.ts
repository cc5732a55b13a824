// The module of garments against its types and against the native command.
import { beforeAll, describe, expect, it } from 'vitest';
import type { RefinementModule } from '../../src/refinement/bindings/refinement-module';
import { sceneFiles } from '../../src/refinement/run/scene-files';
import { sceneText } from '../../src/refinement/state/garments';
import { basePatterns, type PlanFile } from '../../src/refinement/state/plan-file';
import { fabricsText } from '../../src/shared/fabric/fabric-data';
import { loadModule } from '../support/built-module';
import { recordBytes } from '../support/garment-workers';
import { nativePositions } from '../support/native-command';

let module: RefinementModule;
beforeAll(async () => {
  module = await loadModule();
});

function sheet(refinement: object): object {
  return {
    name: 'sheet',
    cloth: {
      sheet: {
        width_m: 1,
        height_m: 1,
        columns: 6,
        rows: 6,
        origin_m: [-0.5, 1.5, 0],
        warp_direction: [0, -0.8, 0.6],
        weft_direction: [1, 0, 0],
      },
    },
    fabric: { name: 'fine cotton' },
    pins: [{ part: 'upper_edge' }],
    refinement,
  };
}

/** Bent along one side, so that a plan refines there. */
function bentPlan(): PlanFile {
  const study = new module.ExampleStudy(fabricsText);
  try {
    const opened = JSON.parse(study.open(JSON.stringify(sheet({ level: 2 })), {}));
    expect(opened).toMatchObject({ ok: true, n_base_vertices: 49, n_vertices: 625 });
    const features = new Float64Array(2 * opened.n_vertices);
    for (let vertex = 0; vertex < 49; ++vertex)
      features.set([vertex % 7 < 2 ? 8 : 1, vertex % 7 < 1 ? 4 : 0.5], 2 * vertex);
    expect(JSON.parse(study.sort('bent', features, 3))).toMatchObject({ ok: true });
    const planned = JSON.parse(study.plan('{"demand": 3}'));
    expect(planned.ok).toBe(true);
    return planned.plan;
  } finally {
    study.delete();
  }
}

describe('the module of garments', () => {
  it('plans from all examples, of which the highest pattern of a vertex counts', () => {
    const study = new module.ExampleStudy(fabricsText);
    study.open(JSON.stringify(sheet({ level: 1 })), {});
    const bent = (isBent: (column: number) => boolean) =>
      Float64Array.from({ length: 2 * 169 }, (_, k) => {
        const vertex = Math.floor(k / 2);
        return vertex < 49 && isBent(vertex % 7) ? 8 : 1;
      });
    study.sort(
      'left',
      bent((column) => column < 2),
      2,
    );
    study.sort(
      'right',
      bent((column) => column > 5),
      2,
    );
    const { plan } = JSON.parse(study.plan('{"demand": 3}')) as { plan: PlanFile };
    study.delete();
    expect(plan.examples.map(({ name }) => name)).toEqual(['left', 'right']);
    expect(basePatterns(plan).slice(0, 7)).toEqual([1, 1, 0, 0, 0, 0, 1]);
  });

  it('refuses a criterion that it does not know', () => {
    const study = new module.ExampleStudy(fabricsText);
    study.open(JSON.stringify(sheet({ level: 1 })), {});
    const answer = JSON.parse(study.plan('{"criterion": "beauty", "max_vertices": 60}'));
    study.delete();
    expect(answer).toMatchObject({
      ok: false,
      where: '/criterion',
      what: 'expected shape or curvature',
    });
  });

  it('moves cloth with hanging vertices as the native command does', () => {
    const steps = 60;
    for (const solver of ['cholmod', 'cg']) {
      const scene = {
        ...sheet({ plan: bentPlan() }),
        method: { stepper: 'implicit', step_s: 0.004, solver, tolerance: 1e-12 },
        duration_s: 0.004 * steps,
        record: { every_s: 0.004 * steps, format: 'binary' },
      };
      const run = new module.GarmentRun(fabricsText);
      const loaded = JSON.parse(run.load(JSON.stringify(scene), {}));
      expect(loaded).toMatchObject({ ok: true });
      expect(loaded.n_hanging).toBeGreaterThan(5);
      expect(run.step(steps)).toBe(0);
      const moved = run.positions().slice();
      run.delete();
      const native = nativePositions(scene);
      expect(moved.length).toBe(native.length);
      const farthest = Math.max(...native.map((value, k) => Math.abs(value - (moved[k] ?? 9))));
      expect(farthest).toBeLessThan(1e-6); // floats for drawing
    }
  });

  it('dresses a walking figure, whose pelvis and solids it tells', async () => {
    const run = new module.GarmentRun(fabricsText);
    const text = sceneText('skirt', 'walk', 'fine cotton', { level: 0 });
    const files = await sceneFiles('skirt', recordBytes);
    expect(JSON.parse(run.load(text, files))).toMatchObject({ ok: true, n_vertices: 714 });
    const before = JSON.parse(run.solids());
    expect(before.cones.length).toBeGreaterThan(8);
    expect(run.step(12)).toBe(0);
    expect(run.time()).toBeCloseTo(0.2, 9);
    const after = JSON.parse(run.solids());
    expect(after.pelvis_m[0]).toBeGreaterThan(before.pelvis_m[0]);
    expect(run.positions().every(Number.isFinite)).toBe(true);
    run.delete();
  });

  it('refuses a file that was not handed over, and frames of another mesh', async () => {
    const files = await sceneFiles('skirt', recordBytes);
    const run = new module.GarmentRun(fabricsText);
    const text = sceneText('skirt', 'walk', 'fine cotton', { level: 0 });
    expect(JSON.parse(run.load(text, {}))).toMatchObject({ ok: false, kind: 'input' });
    expect(JSON.parse(run.put(new Float32Array(3), 0))).toMatchObject({ ok: false });
    expect(JSON.parse(run.load(text, files))).toMatchObject({ ok: true });
    const refused = JSON.parse(run.put(new Float32Array(3), 0));
    expect(refused.what).toContain('714 vertices, got 1');
    run.delete();
  });

  it('shows what a coarse mesh can show of a fine shape, and how far it is from it', () => {
    const run = new module.GarmentRun(fabricsText);
    const fine = new module.GarmentRun(fabricsText);
    run.load(JSON.stringify(sheet({ level: 0 })), {});
    fine.load(JSON.stringify(sheet({ level: 1 })), {});
    fine.step(20);
    const places = fine.positions().slice();
    expect(JSON.parse(run.compare(places)).what).toContain('fine mesh to hold frames against');
    run.holdAgainst(JSON.stringify(sheet({ level: 1 })), {});
    expect(JSON.parse(run.putSample(places, 0.3))).toEqual({ ok: true });
    expect(run.time()).toBe(0.3);
    expect(run.positions().subarray(0, 147)).toEqual(places.subarray(0, 147));
    const { rms_m: rms, lost_m: lost, lost_normals_rad: turned } = JSON.parse(run.compare(places));
    expect(rms).toBeLessThan(0.02);
    expect(lost).toBeCloseTo(rms, 12); // the sample is shown
    expect(turned).toBeGreaterThan(0);
    expect(Math.max(...run.distances())).toBe(0);
    run.reset();
    expect(JSON.parse(run.compare(places)).rms_m).toBeGreaterThan(lost);
    expect(JSON.parse(run.compare(places)).lost_m).toBe(lost);
    run.delete();
    fine.delete();
  });

  it('gathers folds of frames, and tells runs apart by them', async () => {
    const run = new module.GarmentRun(fabricsText);
    const text = sceneText('skirt', 'walk', 'fine cotton', { level: 0 });
    const files = await sceneFiles('skirt', recordBytes);
    run.load(text, files);
    run.holdAgainst(sceneText('skirt', 'walk', 'fine cotton', { level: 1 }), files);
    expect(JSON.parse(run.compareFolds(run.folds(), run.folds()))).toMatchObject({ ok: false });
    run.addFolds();
    const begin = run.folds().slice();
    expect(begin.length).toBe(3 * 18); // rings, of 3 to 20 folds each
    run.step(30);
    run.addFolds();
    const later = run.folds().slice();
    const apart = (a: Float64Array, b: Float64Array) =>
      JSON.parse(run.compareFolds(a, b)).distance_m;
    expect(apart(begin, begin)).toBe(0);
    expect(apart(begin, later)).toBeGreaterThan(1e-5);
    expect(apart(begin, later)).toBe(apart(later, begin));
    run.reset();
    expect(run.folds().length).toBe(0);
    run.delete();
  });
});
