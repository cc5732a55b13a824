import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { invitingVertex } from '../../src/motion/stage/inviting';
import { fabrics } from '../../src/shared/fabric/fabric-data';
import { lookOf } from '../../src/shared/fabric/fabric-look';
import { MAGNITUDE_MAP, paint, roundedUp, SIGNED_MAP } from '../../src/shared/stage/colormap';
import { nearestSeen, pick } from '../../src/shared/stage/pick';

/** Relative luminance of a table's entry. */
function luminance(table: Float32Array, entry: number): number {
  const [r = 0, g = 0, b = 0] = table.subarray(3 * entry, 3 * entry + 3);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

describe('colormap', () => {
  it('gets lighter with every magnitude', () => {
    for (let entry = 8; entry < 256; entry += 8) {
      const step =
        luminance(MAGNITUDE_MAP.table, entry) - luminance(MAGNITUDE_MAP.table, entry - 8);
      expect(step).toBeGreaterThan(0);
    }
  });

  it('is lightest at zero and as dark at both ends of a signed scale', () => {
    const { table } = SIGNED_MAP;
    const middle = luminance(table, 128);
    expect(middle).toBeGreaterThan(0.85);
    for (const end of [0, 255]) expect(luminance(table, end)).toBeLessThan(0.2);
  });

  it('clamps values beyond the scale and survives an empty one', () => {
    const colours = new Float32Array(9);
    paint(MAGNITUDE_MAP, Float32Array.from([-1, 0.5, 9]), 0, 1, colours);
    expect([...colours.subarray(0, 3)]).toEqual([...MAGNITUDE_MAP.table.subarray(0, 3)]);
    expect([...colours.subarray(6, 9)]).toEqual([...MAGNITUDE_MAP.table.subarray(765, 768)]);
    paint(MAGNITUDE_MAP, Float32Array.from([1, 2, 3]), 0, 0, colours);
    expect(colours.every(Number.isFinite)).toBe(true);
  });

  it.each([
    [0.0034, 0.005],
    [0.2, 0.2],
    [0.51, 1],
    [0, 0],
  ])('rounds %f up to %f', (value, rounded) => {
    expect(roundedUp(value)).toBeCloseTo(rounded, 12);
  });
});

describe('fabric-look', () => {
  it('gives no two fabrics the same look', () => {
    const looks = fabrics.map((fabric) => JSON.stringify(lookOf(fabric.id)));
    expect(new Set(looks).size).toBe(fabrics.length);
  });
});

describe('nearestSeen', () => {
  // The eye at the origin looks along -z at a picture of 200 by 100 pixels: w is the depth.
  const matrix = [1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, -1, 0, 0, 0, 0];
  const picture = { matrix, width: 200, height: 100 };
  // At (100, 50), at (120, 50), and behind the eye.
  const positions = Float32Array.from([0, 0, -1, 0.4, 0, -2, 0, 0, 1]);

  it('is the vertex nearest to the point, within reach', () => {
    expect(nearestSeen(positions, picture, { x: 103, y: 46 }, 24)).toBe(0);
    expect(nearestSeen(positions, picture, { x: 113, y: 50 }, 24)).toBe(1);
    expect(nearestSeen(positions, picture, { x: 120, y: 73 }, 24)).toBe(1);
  });

  it('is none beyond reach, and never one behind the eye', () => {
    expect(nearestSeen(positions, picture, { x: 120, y: 75 }, 24)).toBeNull();
    expect(nearestSeen(positions.subarray(6), picture, { x: 100, y: 50 }, 24)).toBeNull();
  });
});

describe('invitingVertex', () => {
  // A square of three by three vertices, upright; the eye looks from in front.
  const places = [0, 1, 2].flatMap((row) => [0, 1, 2].flatMap((column) => [column, 2 - row, 0]));
  const cell = (a: number) => [a, a + 3, a + 1, a + 1, a + 3, a + 4];
  const triangles = Uint32Array.from([0, 1, 3, 4].flatMap(cell));
  const towards = new Vector3(0, 0, 1);

  it('has cloth all around it', () => {
    expect(invitingVertex(Float32Array.from(places), triangles, towards)).toBe(4);
  });

  it('is on the border of a cloth that has nothing else', () => {
    const corner = Float32Array.from([0, 1, 0, 0, 0, 0, 1, 1, 0]);
    expect(invitingVertex(corner, Uint32Array.from([0, 1, 2]), towards)).toBe(1);
  });
});

describe('pick', () => {
  // Two unit squares facing z, the second one two metres behind the first.
  const square = (z: number) => [0, 0, z, 1, 0, z, 1, 1, z, 0, 1, z];
  const positions = Float32Array.from([...square(0), ...square(-2)]);
  const triangles = Uint32Array.from([0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7]);

  it('meets the nearer square, at the right distance and point', () => {
    const hit = pick(positions, triangles, [0.75, 0.2, 5], [0, 0, -1]);
    expect(hit?.distance).toBeCloseTo(5, 6);
    expect(hit?.point[0]).toBeCloseTo(0.75, 6);
    expect(hit?.vertex).toBe(1);
  });

  it('meets a triangle from behind too', () => {
    expect(pick(positions, triangles, [0.2, 0.7, -9], [0, 0, 1])?.vertex).toBe(7);
  });

  it('meets nothing beside, behind the eye, or along the plane', () => {
    expect(pick(positions, triangles, [1.01, 0.5, 5], [0, 0, -1])).toBeNull();
    expect(pick(positions, triangles, [0.5, 0.5, -3], [0, 0, -1])).toBeNull();
    expect(pick(positions, triangles, [-1, 0.5, 0], [1, 0, 0])).toBeNull();
  });
});
