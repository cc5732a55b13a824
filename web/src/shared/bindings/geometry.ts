// Places and solids as the modules tell them.

export type Triple = [number, number, number];

export type Collider =
  | { shape: 'plane'; point: Triple; normal: Triple }
  | { shape: 'sphere'; centre: Triple; radius_m: number };
