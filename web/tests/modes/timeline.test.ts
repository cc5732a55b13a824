import { describe, expect, it } from 'vitest';
import type { FilledFrame } from '../../src/modes/bindings/modal-module';
import { worstVolumes } from '../../src/modes/panels/completion-words';
import { swung, thereAndBack } from '../../src/modes/run/swing';
import { bent } from '../../src/modes/state/key-shapes';
import { modeNumbers } from '../../src/modes/state/material';
import { enclosedVolume, farthestMove, mixInto } from '../../src/modes/state/mix';
import { pulledMix, timeNearest } from '../../src/modes/state/pull';
import { frameCount, placeIn, shapeAt, straightAt } from '../../src/modes/state/timeline';
import { extentOf } from '../../src/shared/state/vectors';

function frame(time: number, volume = 1, straight = volume): FilledFrame {
  return {
    time,
    left: Math.floor(time),
    share_of_next: time % 1,
    unequal_halves: 0,
    volume_m3: volume,
    straight_volume_m3: straight,
    strain: 0,
    straight_strain: 0,
  };
}

describe('timeline', () => {
  const frames = [frame(0), frame(0.25), frame(1), frame(2)];
  const filled = Float32Array.from([0, 0, 0, 4, 0, 0, 4, 8, 0, 0, 0, 8]); // one vertex

  it('meets every frame at its time and lies between them else', () => {
    const target = new Float32Array(3);
    const at = (time: number) => {
      shapeAt(target, filled, frames, time);
      return [...target];
    };
    expect(at(0)).toEqual([0, 0, 0]);
    expect(at(0.25)).toEqual([4, 0, 0]);
    expect(at(0.625)).toEqual([4, 4, 0]);
    expect(at(1)).toEqual([4, 8, 0]);
    expect(at(2)).toEqual([0, 0, 8]);
  });

  it('goes straight from key to key for the ghost, the last key included', () => {
    const keys = [0, 1, 5].map((x) => ({ positions: Float64Array.of(x, 0, 0) }));
    const target = new Float32Array(3);
    const x = (time: number) => {
      straightAt(target, keys, time);
      return target[0];
    };
    expect([x(0), x(0.5), x(1), x(1.5), x(2)]).toEqual([0, 0.5, 1, 3, 5]);
  });

  it('finds its place among times that are not even', () => {
    expect(placeIn([0, 0.25, 1, 2], 0.25)).toEqual({ at: 1, share: 0 });
    expect(placeIn([0, 0.25, 1, 2], 2)).toEqual({ at: 2, share: 1 });
    expect(frameCount(2)).toBe(17);
    expect(frameCount(8)).toBe(113);
  });

  it('knows the time at which a vertex is nearest to a hand', () => {
    expect(timeNearest(filled, frames, 0, [6, 4, -1])).toBeCloseTo(0.625, 12);
    expect(timeNearest(filled, frames, 0, [-9, 0, -1])).toBe(0);
  });

  it('holds volumes against those of the keys beside them', () => {
    const grown = [frame(0, 1), frame(0.5, 1.06, 0.75), frame(1, 1), frame(2, 2)];
    const { ours, straight } = worstVolumes({ frames: grown });
    expect(ours).toBeCloseTo(1.06, 12);
    expect(straight).toBeCloseTo(0.75, 12);
    const swelling = [frame(0, 1), frame(0.5, 1.5), frame(1, 2)];
    expect(worstVolumes({ frames: swelling }).ours).toBe(1);
  });

  it('goes there and back', () => {
    expect([0, 1, 2, 3, 4, 5].map((way) => thereAndBack(way, 2))).toEqual([0, 1, 2, 1, 0, 1]);
  });
});

describe('mix of modes', () => {
  const shape = Float64Array.of(0, 0, 0, 1, 0, 0);
  const moves = Float32Array.of(0, 0, 0, 0, 1, 0, /**/ 0, 0, 1, 0, 0, -1);

  it('adds each mode as far as it reaches', () => {
    const target = new Float64Array(6);
    mixInto(target, shape, moves, [0.5, -1], 0.2);
    const wanted = [0, 0, -0.2, 1, 0.1, 0.2];
    wanted.forEach((value, index) => {
      expect(target[index]).toBeCloseTo(value, 12);
    });
    expect(extentOf(shape)).toBe(1);
    expect(farthestMove(shape, Float64Array.of(0, 0, 0, 1, 3, 4))).toBe(5);
  });

  it('swings from full amplitude, the stiffer mode faster', () => {
    const modes = modeNumbers([1, 4], 'volume', false);
    expect(swung([0.5, 1], modes, 0)).toEqual([0.5, 1]);
    const [slow = 0, fast = 0] = swung([0.5, 1], modes, 1); // half a swing and a whole one
    expect(slow).toBeCloseTo(-0.5, 12);
    expect(fast).toBeCloseTo(1, 12);
    expect(swung([0, 1], modes, 1)[1]).toBeCloseTo(-1, 12); // alone it is the slowest
  });

  it('follows a hand with the softest modes, and no farther than full amplitude', () => {
    const modes = modeNumbers([1, 100], 'volume', false);
    const [first = 0, second = 0] = pulledMix(moves, modes, 6, 1, 0.2, [0, 0.1, 0]);
    expect(first).toBeCloseTo(0.5, 2);
    expect(second).toBeCloseTo(0, 6);
    const far = pulledMix(moves, modes, 6, 1, 0.2, [0, 9, -9]);
    expect(far[0]).toBe(1);
    expect(far[1]).toBeLessThanOrEqual(1);
  });

  it('has hertz where a thickness is known, and names what falls', () => {
    const [swings] = modeNumbers([1], 'volume', true);
    expect(swings?.hz).toBeCloseTo(Math.sqrt(1000) / (2 * Math.PI), 12);
    expect(modeNumbers([1], 'volume', false)[0]?.hz).toBe(null);
    expect(modeNumbers([1], 'surface', true)[0]?.hz).toBe(null);
    const [falls, first] = modeNumbers([-3, 4], 'cloth', false);
    expect(falls).toMatchObject({ falls: true, hz: null });
    expect(first).toMatchObject({ falls: false, relative: 1, hz: 1 / Math.PI });
  });
});

describe('bent key', () => {
  it('keeps the length of its middle line and what a closed body holds', () => {
    const line = Float64Array.of(-1, 0, 0, 0, 0, 0, 1, 0, 0);
    const arc = bent(line, 180);
    const radius = 2 / Math.PI;
    expect(arc[0]).toBeCloseTo(-radius, 12);
    expect(arc[1]).toBeCloseTo(radius, 12);
    expect([...arc.subarray(3, 6)]).toEqual([0, 0, 0]);
    expect([...bent(line, 0)]).toEqual([...line]);
  });

  it('measures what a tetrahedron holds', () => {
    const corners = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1];
    const faces = Uint32Array.of(0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3);
    expect(enclosedVolume(corners, faces)).toBeCloseTo(1 / 6, 12);
    const moved = corners.map((value) => value + 7);
    expect(enclosedVolume(moved, faces)).toBeCloseTo(1 / 6, 12);
  });
});
