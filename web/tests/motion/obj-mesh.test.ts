import { describe, expect, it } from 'vitest';
import {
  type Hold,
  holdFor,
  holdsOf,
  liesFlat,
  type ObjMesh,
} from '../../src/motion/state/obj-mesh';
import { presetSetting, sceneOf } from '../../src/motion/state/setting';

const standing: ObjMesh = {
  name: 'shirt.obj',
  isOwn: true,
  unit: 'm',
  odd: null,
  clothText: '{"mesh":{"positions_m":[]}}',
  groups: ['waist'],
  nVertices: 4,
  nTriangles: 2,
  low: [-1, 2, -0.5],
  high: [1, 4, 0.5],
  threads: 'texture',
};
const flat: ObjMesh = { ...standing, low: [-1, 1, -1], high: [1, 1.01, 1] };
const withHold = (hold: Hold) => ({ ...presetSetting('obj'), hold });

describe('obj-mesh', () => {
  it('lies flat when it is low beside its length, at any size', () => {
    for (const size of [0.01, 1, 100]) {
      const scaled = ({ low, high }: ObjMesh) => ({
        low: low.map((value) => size * value) as ObjMesh['low'],
        high: high.map((value) => size * value) as ObjMesh['high'],
      });
      expect(liesFlat(scaled(flat))).toBe(true);
      expect(liesFlat(scaled(standing))).toBe(false);
    }
  });

  it('is held by the top fiftieth of its height, a group, or nothing', () => {
    expect(sceneOf(withHold('highest'), standing).pins).toEqual([
      { box: { low_m: [-1, 3.96, -0.5], high_m: [1, 4, 0.5] } },
    ]);
    expect(sceneOf(withHold('group:waist'), standing).pins).toEqual([{ part: 'waist' }]);
    expect(sceneOf(withHold('nothing'), standing).pins).toEqual([]);
  });

  it('is held by what it has when a link names a group of another mesh', () => {
    expect(holdFor(standing, 'group:collar')).toBe('highest');
    expect(holdFor(flat, 'group:collar')).toBe('nothing');
  });

  it('does not offer the highest points where they would be all', () => {
    expect(holdsOf(standing)).toEqual(['highest', 'group:waist', 'nothing']);
    expect(holdsOf(flat)).toEqual(['group:waist', 'nothing']);
  });

  it('has the floor under it and the air of the preset around it', () => {
    const { cloth, world } = sceneOf(withHold('highest'), standing);
    expect(cloth).toEqual({ mesh: { positions_m: [] } });
    expect(world).toMatchObject({ air: { density_kg_per_m3: 1.2 } });
    const [{ plane }] = (world as { colliders: [{ plane: { point_m: [0, number, 0] } }] })
      .colliders;
    expect(plane.point_m[1]).toBeCloseTo(2 - 0.1 * 3, 12);
  });

  it('is no part of another preset', () => {
    expect(sceneOf(presetSetting('curtain'), standing)).toEqual(sceneOf(presetSetting('curtain')));
  });
});
