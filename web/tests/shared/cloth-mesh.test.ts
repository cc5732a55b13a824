import {
  type BufferGeometry,
  type LineSegments,
  type Mesh,
  type MeshPhysicalMaterial,
  Texture,
} from 'three';
import { describe, expect, it } from 'vitest';
import { createClothMesh } from '../../src/shared/stage/cloth-mesh';

const SIDE = 4; // vertices along one side of the sheet

/** A frame of a sheet that lies in the plane z = slope x, with a stretch that grows with x. */
function frame(slope: number): ArrayBuffer {
  const nVertices = SIDE * SIDE;
  const values = new Float32Array(4 * nVertices);
  for (let v = 0; v < nVertices; ++v) {
    const [x, y] = [v % SIDE, Math.floor(v / SIDE)];
    values.set([x, y, slope * x], 3 * v);
    values[3 * nVertices + v] = 0.01 * x - 0.01;
  }
  return values.buffer;
}

function triangles(): Uint32Array {
  const corners: number[] = [];
  for (let row = 0; row + 1 < SIDE; ++row) {
    for (let column = 0; column + 1 < SIDE; ++column) {
      const a = row * SIDE + column;
      corners.push(a, a + 1, a + SIDE, a + 1, a + SIDE + 1, a + SIDE);
    }
  }
  return Uint32Array.from(corners);
}

function makeCloth(slope: number) {
  const cloth = createClothMesh();
  cloth.setTopology(triangles(), SIDE * SIDE);
  cloth.setFrame(frame(slope), 'stretch');
  const [front] = cloth.object.children as Mesh[];
  const edges = cloth.object.children.at(-1) as LineSegments;
  return { cloth, geometry: front?.geometry as BufferGeometry, edges: edges.geometry };
}

describe('cloth-mesh', () => {
  it.each([0, 1, -2])('gives a plane of slope %f the same unit normal everywhere', (slope) => {
    const { cloth, geometry } = makeCloth(slope);
    cloth.update();
    const normals = geometry.getAttribute('normal');
    const length = Math.hypot(slope, 1);
    for (let v = 0; v < normals.count; ++v) {
      expect(normals.getX(v)).toBeCloseTo(-slope / length, 5);
      expect(normals.getY(v)).toBeCloseTo(0, 5);
      expect(normals.getZ(v)).toBeCloseTo(1 / length, 5);
    }
  });

  it('draws each edge once (vertices - edges + triangles = 1)', () => {
    const { edges } = makeCloth(0);
    const nEdges = (edges.getIndex()?.count ?? 0) / 2;
    expect(SIDE * SIDE - nEdges + triangles().length / 3).toBe(1);
  });

  it('scales the heat map to the frame, or to the fixed end', () => {
    const { cloth } = makeCloth(0);
    cloth.setHeat('magnitude', 'auto');
    cloth.update();
    expect(cloth.heatScale()).toMatchObject({ map: 'magnitude', low: 0 });
    expect(cloth.heatScale().high).toBeCloseTo(0.02, 6);
    cloth.setHeat('signed', 5);
    cloth.update();
    expect(cloth.heatScale().low).toBeCloseTo(-0.05, 6);
    expect(cloth.heatScale().least).toBeCloseTo(-0.01, 6);
    expect(cloth.heatScale().most).toBeCloseTo(0.02, 6);
  });

  it('paints distances on a scale of their own, and grey where there is no number', () => {
    const { cloth, geometry } = makeCloth(0);
    const colours = () => Array.from(geometry.getAttribute('color').array as Float32Array);
    cloth.setHeat('distance', 5);
    cloth.update();
    expect(cloth.heatScale().most).toBeNaN();
    expect(new Set(colours()).size).toBe(1);
    expect(colours()[0]).toBeGreaterThan(0.1);
    cloth.setFrame(frame(0), 'distance');
    cloth.update();
    expect(cloth.heatScale()).toMatchObject({ map: 'distance', low: 0 });
    expect(cloth.heatScale().high).toBeCloseTo(0.02, 6);
    expect(new Set(colours()).size).toBeGreaterThan(3);
  });

  it('takes the new mesh after the level changed', () => {
    const { cloth, geometry } = makeCloth(0);
    cloth.update();
    cloth.setTopology(Uint32Array.from([0, 1, 2]), 3);
    cloth.setFrame(Float32Array.from([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0]).buffer, 'stretch');
    cloth.update();
    expect(geometry.getAttribute('position').count).toBe(3);
    expect(geometry.getIndex()?.count).toBe(3);
  });

  it('wears a print as long as its mesh has the vertices of the print', () => {
    const { cloth, geometry } = makeCloth(0);
    const [front, back] = cloth.object.children as Mesh[];
    const maps = () =>
      [front, back].map((one) => one && (one.material as MeshPhysicalMaterial).map);
    const texture = new Texture();
    cloth.setPrint({ texture, coordinates: new Float32Array(2 * SIDE * SIDE).fill(0.5) });
    expect(maps()).toEqual([texture, texture]);
    expect(geometry.getAttribute('uv').count).toBe(SIDE * SIDE);
    cloth.setTopology(Uint32Array.from([0, 1, 2]), 3);
    expect(maps()).toEqual([null, null]);
    expect(geometry.hasAttribute('uv')).toBe(false);
    cloth.setTopology(triangles(), SIDE * SIDE);
    expect(maps()).toEqual([texture, texture]);
    cloth.setPrint(null);
    expect(maps()).toEqual([null, null]);
  });
});
