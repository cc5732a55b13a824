// Places and solids as the modules tell them.

export type Triple = [number, number, number];

/** A solid by its word in scene files, with what stands there. */
export type Collider =
  | { shape: 'plane'; point_m: Triple; normal: Triple }
  | { shape: 'sphere'; centre_m: Triple; radius_m: number }
  | { shape: 'capsule'; a_m: Triple; b_m: Triple; radius_m: number }
  | {
      shape: 'box';
      centre_m: Triple;
      size_m: Triple;
      x_direction: Triple;
      y_direction: Triple;
    }
  | { shape: 'mesh'; offset_m: Triple; surface: Surface };

/** A closed surface at time 0. */
export interface Surface {
  /** Tells it from others. */
  id: string;
  /** x, y and z of each vertex [m]. */
  positions: Float32Array;
  triangles: Uint32Array;
}
