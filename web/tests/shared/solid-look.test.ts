import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import schema from '../../../core/scene/scene_schema.json';
import type { Collider } from '../../src/shared/bindings/geometry';
import { bodiesOf, lookOf } from '../../src/shared/stage/solid-look';

const { motion, friction, ...words } = schema.$defs.collider.properties;

/** A solid as the module tells it, with the numbers that a scene leaves out. */
function usualSolid(word: string, numbers: Record<string, { default?: unknown }>): Collider {
  const told = Object.entries(numbers).map(([key, number]) => [key, number.default]);
  return { shape: word, ...Object.fromEntries(told) };
}

describe('the look of solids', () => {
  it('knows every solid that a scene can name', () => {
    expect(motion && friction).toBeDefined();
    expect(Object.keys(words).length).toBeGreaterThan(1);
    for (const [word, { properties }] of Object.entries(words)) {
      const look = lookOf(usualSolid(word, properties));
      expect(look, word).toBeDefined();
      if (look.body) expect(look.body.box.isEmpty(), word).toBe(false);
    }
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

  it('takes a level plane for the floor, and no slope', () => {
    const floorOf = (normal: [number, number, number]) =>
      lookOf({ shape: 'plane', point_m: [0, 0.8, 0], normal }).floor;
    expect(floorOf([0, 1, 0])).toBe(0.8);
    expect(floorOf([0, Math.SQRT1_2, Math.SQRT1_2])).toBeNull();
  });
});
