// The captions of the shipped experiments, held to the shapes that the module finds.

import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { beforeAll, describe, expect, it } from 'vitest';
import type { TermNumbers } from '../../src/fabrics/bindings/deform-module';
import {
  type ClothAnswer,
  type DeformationHandle,
  type DeformModule,
  WAY,
} from '../../src/fabrics/bindings/deform-module';
import { TERMS, type Term } from '../../src/fabrics/state/deform-state';
import { EXPERIMENTS } from '../../src/fabrics/state/experiments';
import { geometryOf, perTerm } from '../../src/fabrics/state/fabric-geometry';
import { holdsOf, joined } from '../../src/fabrics/state/holds';
import type { Triple as Place } from '../../src/shared/bindings/geometry';
import { fabricNamed, fabrics, fabricsText } from '../../src/shared/fabric/fabric-data';
import { placeOf } from '../../src/shared/state/vectors';
import { loadModule } from '../support/built-module';

const FILES = fileURLToPath(new URL('../../../assets/deform', import.meta.url));

const captionOf = (id: string) =>
  (JSON.parse(readFileSync(`${FILES}/${id}.json`, 'utf8')) as { caption: string }).caption;

let module: DeformModule;

/** An experiment's cloth, and the shapes that it takes. */
class Stand {
  readonly cloth: ClothAnswer;
  readonly held: Set<number>;
  private readonly run: DeformationHandle;

  constructor(id: string) {
    const known = EXPERIMENTS.find((one) => one.id === id);
    this.run = new module.Deformation(fabricsText);
    const text = known?.text ?? readFileSync(`${FILES}/${id}.json`, 'utf8');
    this.cloth = JSON.parse(this.run.open(text, '')) as ClothAnswer;
    this.held = new Set(this.holds().vertices);
  }

  /** Least energy with these weights; the terms are unweighted. */
  shape(weights: TermNumbers, form: 'consistent' | 'published' = 'consistent') {
    this.run.show(JSON.stringify({ form, weights: [weights] }));
    const { vertices, places } = this.holds();
    this.run.hold(vertices, places);
    this.run.restart(0);
    this.run.beginSettling(0, true);
    while (this.run.settle(0) !== WAY.done);
    const { terms } = JSON.parse(this.run.report(0)) as { terms: TermNumbers };
    return { places: this.run.exactPositions(0).slice(), terms };
  }

  of(fabric: string) {
    return this.shape(geometryOf(fabricNamed(fabric)).recomputed).places;
  }

  free(): number[] {
    return Array.from({ length: this.cloth.n_vertices }, (_, v) => v).filter(
      (v) => !this.held.has(v),
    );
  }

  /** Vertices that rest within a distance of a place of the sheet. */
  near([x, , z]: Place, reach: number): number[] {
    return this.free().filter((v) => {
      const [vx, , vz] = placeOf(this.cloth.rest_m, v);
      return Math.hypot(vx - x, vz - z) <= reach;
    });
  }

  close(): void {
    this.run.delete();
  }

  private holds() {
    return joined(holdsOf(this.cloth, this.run.triangles().slice()));
  }
}

const heightOf = (places: Float64Array, vertices: readonly number[]) =>
  vertices.reduce((sum, v) => sum + (places[3 * v + 1] ?? 0), 0) / vertices.length;

const only = (...terms: Term[]) => perTerm((term) => (terms.includes(term) ? 1 / terms.length : 0));

/** Correlation of ranks: 1 where both go up together, -1 where one goes down as the other goes up. */
function rankCorrelation(a: readonly number[], b: readonly number[]): number {
  const ranks = (values: readonly number[]) =>
    values.map((value) => values.filter((other) => other < value).length);
  const [ra, rb] = [ranks(a), ranks(b)];
  const n = a.length;
  const squares = ra.reduce((sum, rank, k) => sum + (rank - (rb[k] ?? 0)) ** 2, 0);
  return 1 - (6 * squares) / (n * (n * n - 1));
}

describe('captions of experiments', () => {
  beforeAll(async () => {
    module = await loadModule();
  });

  it('pull: silk lifts narrow peaks, linen most of the sheet', () => {
    expect(captionOf('pull')).toMatch(/silk, a handle lifts a narrow peak.*linen, most of the/);
    const recovery = fabrics.map((one) => geometryOf(one).recomputed.recovery);
    expect(Math.max(...recovery)).toBe(geometryOf(fabricNamed('silk')).recomputed.recovery);
    expect(Math.min(...recovery)).toBe(geometryOf(fabricNamed('linen')).recomputed.recovery);
    const stand = new Stand('pull');
    const [silk, linen] = [stand.of('silk'), stand.of('linen')];
    /** The part of the sheet that is lifted by a third of the handles' way, and more. */
    const lifted = (places: Float64Array) =>
      stand.free().filter((v) => (places[3 * v + 1] ?? 0) > 0.1 / 3).length / stand.free().length;
    expect(lifted(silk)).toBeLessThan(0.1);
    expect(lifted(linen)).toBeGreaterThan(0.5);
    stand.close();
  });

  it('ball: the held cap lies on the ball, other cloth passes through it', () => {
    expect(captionOf('ball')).toContain('the cap that is held lies on the ball, the rest may pass');
    const { centre_m: centre, radius_m: radius } = { centre_m: [0, 0.03, 0], radius_m: 0.09 };
    const stand = new Stand('ball');
    const places = stand.of('silk');
    const depth = (v: number) =>
      radius - Math.hypot(...placeOf(places, v).map((x, axis) => x - (centre[axis] ?? 0)));
    const cap = stand.cloth.handles.flatMap(({ vertices }) => vertices);
    expect(cap.length).toBeGreaterThan(10);
    for (const v of cap) expect(Math.abs(depth(v))).toBeLessThan(1e-6);
    expect(Math.max(...stand.free().map(depth))).toBeGreaterThan(0.001);
    stand.close();
  });

  it('diagonal stretch: the cloth narrows across the pull', () => {
    expect(captionOf('diagonal_stretch')).toContain('how much the cloth narrows across it');
    const stand = new Stand('diagonal_stretch');
    const places = stand.of('linen');
    // Two places on a line across the diagonal, a third of the way in from the pulled corner.
    const across: Place[] = [
      [0.19, 0, 0.03],
      [0.06, 0, 0.16],
    ];
    const ends = across.map((place) => stand.near(place, 0.006)[0] ?? -1);
    const width = (at: ArrayLike<number>) => {
      const [a, b] = ends.map((v) => placeOf(at, v));
      return Math.hypot(...(a ?? []).map((x, axis) => x - (b?.[axis] ?? 0)));
    };
    expect(width(places)).toBeLessThan(0.995 * width(stand.cloth.rest_m));
    stand.close();
  });

  it('wrinkles: between the crests linen stays up and silk falls back', () => {
    expect(captionOf('wrinkles')).toMatch(/weighs bending most stays up.*recovery most falls back/);
    const stand = new Stand('wrinkles');
    const between = stand.near([0, 0, 0], 0.03);
    const [linen, silk] = [stand.of('linen'), stand.of('silk')];
    expect(heightOf(linen, between)).toBeGreaterThan(0.03);
    expect(heightOf(silk, between)).toBeLessThan(0.01);
    stand.close();
  });

  it('terms: recovery leaves a spike, stretch draws the cloth after it, bending rounds it', () => {
    expect(captionOf('terms')).toContain(
      'recovery alone leaves a spike, stretch draws the cloth after it, bending rounds it',
    );
    const stand = new Stand('terms');
    const around = stand.near([0, 0, 0], 0.06);
    const alone = stand.shape(only('recovery')).places;
    const stretched = stand.shape(only('recovery', 'stretch')).places;
    const rounded = stand.shape(only('recovery', 'stretch', 'bending')).places;
    expect(heightOf(alone, around)).toBeLessThan(0.005);
    expect(heightOf(stretched, around)).toBeGreaterThan(heightOf(alone, around) + 0.005);
    /** How much a ring around the handle lies below it, beside a ring twice as far: 1/2 for a cone. */
    const steepness = (places: Float64Array) => {
      const ring = (r: number) =>
        heightOf(
          places,
          stand
            .near([0, 0, 0], r + 0.008)
            .filter((v) => !stand.near([0, 0, 0], r - 0.008).includes(v)),
        );
      return (0.1 - ring(0.04)) / (0.1 - ring(0.08));
    };
    expect(steepness(rounded)).toBeLessThan(steepness(stretched) - 0.05);
    stand.close();
  });

  it('fifteen fabrics: more weight on a term goes with less of it', () => {
    expect(captionOf('fifteen')).toContain('a fabric with more weight on a term has less of it');
    const stand = new Stand('fifteen');
    const weights = fabrics.map((one) => geometryOf(one).recomputed);
    const shapes = weights.map((one) => stand.shape(one, 'published').terms);
    for (const term of TERMS) {
      const [weight, amount] = [weights.map((w) => w[term]), shapes.map((terms) => terms[term])];
      expect(rankCorrelation(weight, amount), term).toBeLessThan(-0.5);
    }
    stand.close();
  }, 60000);

  it('other captions claim nothing of a shape', () => {
    for (const id of ['half_skirt', 't_shirt'])
      expect(captionOf(id)).not.toMatch(/soft|stiff|follows|stays|falls|narrow|wide/);
  });
});
