// The buffer in which a frame travels between a worker and the page.

/** Numbers of a frame beside positions: stretch, a ratio (usual), or distance to reference [m]. */
export type Scalar = 'stretch' | 'distance';

/** A frame buffer holds the positions (3 n) and then the scalar (n) as 32-bit floats. */
export const FLOATS_PER_VERTEX = 4;

/** The two parts of a frame buffer. */
export function frameViews(buffer: ArrayBuffer): {
  positions: Float32Array;
  scalar: Float32Array;
} {
  const nVertices = buffer.byteLength / (4 * FLOATS_PER_VERTEX);
  return {
    positions: new Float32Array(buffer, 0, 3 * nVertices),
    scalar: new Float32Array(buffer, 12 * nVertices, nVertices),
  };
}
