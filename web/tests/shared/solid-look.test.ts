import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import schema from '../../../core/scene/scene_schema.json';
import type { Collider } from '../../src/shared/bindings/geometry';
import { bodiesOf, lookOf } from '../../src/shared/stage/solid-look';

const { motion, friction, ...words } = schema.$defs.collider.properties;

const PYRAMID = {
  id: 'pyramid',
  positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]),
  triangles: new Uint32Array([0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2]),
};

/** One of each, as the module tells them. */
const SOLIDS: Collider[] = [
  { shape: 'plane', point_m: [0, 0, 0], normal: [0, 1, 0] },
  { shape: 'sphere', centre_m: [0, 0, 0], radius_m: 1 },
  { shape: 'capsule', a_m: [0, 0, 0], b_m: [0, 1, 0], radius_m: 1 },
  {
    shape: 'box',
    centre_m: [1, 0, 0],
    size_m: [1, 2, 4],
    x_direction: [0, 1, 0],
    y_direction: [-1, 0, 0],
  },
  { shape: 'mesh', offset_m: [0, 5, 0], surface: PYRAMID },
];

describe('the look of solids', () => {
  it('knows every solid that a scene can name', () => {
    expect(motion && friction).toBeDefined();
    expect(SOLIDS.map(({ shape }) => shape)).toEqual(Object.keys(words));
    for (const solid of SOLIDS) {
      const { body } = lookOf(solid);
      expect(body === null, solid.shape).toBe(solid.shape === 'plane');
      expect(body?.box.isEmpty() ?? false, solid.shape).toBe(false);
    }
  });

  it('draws boxes and meshes where they are, and turned as they are', () => {
    const [box, mesh] = bodiesOf(SOLIDS.slice(3));
    expect(box?.box.min.toArray()).toEqual([0, -0.5, -2]);
    expect(box?.box.max.toArray()).toEqual([2, 0.5, 2]);
    const drawn = box?.build();
    drawn?.computeBoundingBox();
    expect(drawn?.boundingBox?.max.toArray().map((x) => x.toFixed(4))).toEqual(
      [0.985, 0.4925, 1.97].map((x) => x.toFixed(4)),
    );
    expect(mesh?.centre).toEqual([0, 5, 0]);
    expect(mesh?.box.max.toArray()).toEqual([1, 6, 1]);
    expect(mesh?.build().getAttribute('position').count).toBe(12);
  });

  it('keeps a sphere in view and draws it a little smaller', () => {
    const [body] = bodiesOf([
      { shape: 'plane', point_m: [0, 1, 0], normal: [0, 1, 0] },
      { shape: 'sphere', centre_m: [1, 2, 3], radius_m: 0.5 },
    ]);
    expect(body?.box.min).toEqual(new Vector3(0.5, 1.5, 2.5));
    expect(body?.box.max).toEqual(new Vector3(1.5, 2.5, 3.5));
    const geometry = body?.build();
    geometry?.computeBoundingSphere();
    expect(geometry?.boundingSphere?.radius).toBeCloseTo(0.4925, 6);
  });

  it('draws a capsule along its axis, and the same one wherever it is', () => {
    const capsuleAt = (x: number): Collider => ({
      shape: 'capsule',
      a_m: [x, 1, 0],
      b_m: [x + 0.3, 1, 0.4],
      radius_m: 0.1,
    });
    const [body, moved] = bodiesOf([capsuleAt(0), capsuleAt(0.1)]);
    expect(moved?.form).toBe(body?.form);
    const [low, high] = [body?.box.min.toArray() ?? [], body?.box.max.toArray() ?? []];
    for (const [k, x] of [-0.1, 0.9, -0.1].entries()) expect(low[k]).toBeCloseTo(x, 9);
    for (const [k, x] of [0.4, 1.1, 0.5].entries()) expect(high[k]).toBeCloseTo(x, 9);
    const places = body?.build().getAttribute('position');
    let farthest = 0;
    for (let i = 0; i < (places?.count ?? 0); ++i) {
      const place = new Vector3(places?.getX(i), places?.getY(i), places?.getZ(i));
      const direction = new Vector3(0.6, 0, 0.8);
      const along = Math.max(-0.25, Math.min(0.25, place.dot(direction)));
      const nearest = direction.multiplyScalar(along);
      farthest = Math.max(farthest, Math.abs(place.distanceTo(nearest) - 0.0985));
    }
    expect(farthest).toBeLessThan(1e-6);
  });

  it('takes a level plane for the floor, and no slope', () => {
    const floorOf = (normal: [number, number, number]) =>
      lookOf({ shape: 'plane', point_m: [0, 0.8, 0], normal }).floor;
    expect(floorOf([0, 1, 0])).toBe(0.8);
    expect(floorOf([0, Math.SQRT1_2, Math.SQRT1_2])).toBeNull();
  });
});
