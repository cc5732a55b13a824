// A completed motion: the shape at any time, and the one that goes straight from key to key.
import type { FilledFrame } from '../bindings/modal-module';

export const MOST_KEYS = 8;

/** Frames between two keys, at most so many in all. */
const FRAMES_BETWEEN = 16;
const MOST_FRAMES = 121;

export function frameCount(nKeys: number): number {
  return Math.min(MOST_FRAMES, FRAMES_BETWEEN * (nKeys - 1) + 1);
}

/** Place of a time among ascending times: the one before, and how far on to the next. */
export function placeIn(times: readonly number[], time: number): { at: number; share: number } {
  const last = times.length - 1;
  let at = 0;
  while (at < last - 1 && (times[at + 1] as number) <= time) at += 1;
  const [from, to] = [times[at] ?? 0, times[at + 1] ?? 1];
  const share = Math.min(1, Math.max(0, (time - from) / (to - from)));
  return { at, share };
}

/** Writes (1 - share) a + share b, of `count` numbers from these offsets on. */
function blendInto(
  target: Float32Array,
  a: ArrayLike<number>,
  fromA: number,
  b: ArrayLike<number>,
  fromB: number,
  share: number,
): void {
  for (let k = 0; k < target.length; ++k)
    target[k] = (1 - share) * (a[fromA + k] as number) + share * (b[fromB + k] as number);
}

/** The shape at a time; `filled` has all frames, one after the other. */
export function shapeAt(
  target: Float32Array,
  filled: Float32Array,
  frames: readonly FilledFrame[],
  time: number,
): void {
  const times = frames.map((frame) => frame.time);
  const { at, share } = placeIn(times, time);
  const next = Math.min(at + 1, frames.length - 1);
  blendInto(target, filled, at * target.length, filled, next * target.length, share);
}

/** The shape that every vertex takes on its straight way between the keys. */
export function straightAt(
  target: Float32Array,
  keys: readonly { positions: Float64Array }[],
  time: number,
): void {
  const left = Math.min(Math.floor(time), keys.length - 2);
  const [a, b] = [keys[left], keys[left + 1]];
  if (a && b) blendInto(target, a.positions, 0, b.positions, 0, time - left);
}

/** A number of the frames at a time. */
export function valueAt(
  frames: readonly FilledFrame[],
  time: number,
  of: (frame: FilledFrame) => number,
): number {
  const { at, share } = placeIn(
    frames.map((frame) => frame.time),
    time,
  );
  const a = frames[at];
  const b = frames[at + 1] ?? a;
  return a && b ? (1 - share) * of(a) + share * of(b) : Number.NaN;
}
