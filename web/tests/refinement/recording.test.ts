import { deflateSync } from 'node:zlib';
import { describe, expect, it } from 'vitest';
import {
  decodeFrames,
  encodeFrames,
  type RecordingHead,
  readRecording,
  splitRecording,
} from '../../src/refinement/worker/recording';

/** Two base vertices, the middle of both, and one between the first and that. */
const PARENTS = Int32Array.from([-1, -1, -1, -1, -1, -1, -1, -1, 0, 1, -1, -1, 0, 2, -1, -1]);

const HEAD: RecordingHead = {
  format: 'pleat recording 1',
  name: 'test',
  n_vertices: 4,
  n_components: 3,
  quantum: 1e-4,
  n_frames: 5,
  first_s: 0,
  every_s: 0.1,
  ms_per_frame: null,
};

/** Far from the origin, with a jump and a change of sign. */
const FRAMES = Array.from({ length: HEAD.n_frames }, (_, frame) =>
  Float64Array.from({ length: 12 }, (_, k) => Math.sin(7 * k + frame ** 2) * (k === 5 ? 300 : 2)),
);

function fileOf(head: RecordingHead, body: Uint8Array): Uint8Array {
  return Buffer.concat([Buffer.from(`${JSON.stringify(head)}\n`), body]);
}

describe('recording', () => {
  it('gives places back to half a quantum', () => {
    const decoded = decodeFrames(HEAD, PARENTS, encodeFrames(HEAD, PARENTS, FRAMES));
    expect(decoded?.length).toBe(FRAMES.length);
    decoded?.forEach((frame, index) => {
      frame.forEach((value, k) => {
        const rounding = 2 ** -23 * Math.abs(value);
        const wanted = FRAMES[index]?.[k] ?? Number.NaN;
        expect(Math.abs(value - wanted)).toBeLessThanOrEqual(0.5001 * HEAD.quantum + rounding);
      });
    });
  });

  it('takes one byte a number for what goes on as it went, and lies between its parents', () => {
    const still = Array.from({ length: 6 }, (_, frame) =>
      Float64Array.from({ length: 12 }, (_, k) => {
        const [vertex, axis] = [Math.floor(k / 3), k % 3];
        return 2 * ([0, 1, 0.5, 0.25][vertex] ?? 0) + 0.5 * frame * (axis + 1);
      }),
    );
    const bytes = encodeFrames(HEAD, PARENTS, still);
    const first = encodeFrames(HEAD, PARENTS, still.slice(0, 2));
    expect(bytes.length - first.length).toBe(4 * 12);
    expect(bytes.subarray(first.length).every((byte) => byte === 0)).toBe(true);
  });

  it('reads a file of its own mesh, and nothing else', async () => {
    const body = deflateSync(encodeFrames(HEAD, PARENTS, FRAMES));
    const read = await readRecording(fileOf(HEAD, body), PARENTS);
    expect(read?.head).toEqual(HEAD);
    expect(read?.frames.length).toBe(5);
    expect(await readRecording(fileOf(HEAD, body), PARENTS.subarray(0, 12))).toBeNull();
    expect(await readRecording(fileOf({ ...HEAD, n_frames: 6 }, body), PARENTS)).toBeNull();
    expect(await readRecording(fileOf({ ...HEAD, n_frames: 4 }, body), PARENTS)).toBeNull();
    expect(await readRecording(fileOf(HEAD, body.subarray(0, 20)), PARENTS)).toBeNull();
  });

  it('refuses what is no recording', () => {
    expect(splitRecording(Buffer.from('{"format": "another"}\n'))).toBeNull();
    expect(splitRecording(Buffer.from('no line'))).toBeNull();
    expect(splitRecording(Buffer.from('{\n'))).toBeNull();
  });
});
