// Places and solids as the modules tell them.

export type Triple = [number, number, number];

/** A solid by its word in scene files, with what stands there. */
export type Collider =
  | { shape: 'plane'; point_m: Triple; normal: Triple }
  | { shape: 'sphere'; centre_m: Triple; radius_m: number }
  | { shape: 'capsule'; a_m: Triple; b_m: Triple; radius_m: number };
