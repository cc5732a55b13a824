// How stages show solids: the one place that tells them apart.
import { Box3, type BufferGeometry, SphereGeometry, Vector3 } from 'three';
import type { Collider, Triple } from '../bindings/geometry';

/** A body about the origin, and where it is. */
export interface SolidBody {
  /** Says all that sets its form: a body is built anew when this changes. */
  form: string;
  centre: Triple;
  /** Box that has to stay in view. */
  box: Box3;
  build(): BufferGeometry;
}

export interface SolidLook {
  /** Nothing for a solid without end. */
  body: SolidBody | null;
  /** Height of the floor that it is [m]. */
  floor: number | null;
}

/** A plane tilted by less than 8 degrees, as a cosine, is a floor. */
const FLOOR_COSINE = 0.99;

/** Share of its size at which a body is drawn, so that flat triangles on it do not cut into it. */
const DRAWN = 0.985;

export function lookOf(solid: Collider): SolidLook {
  switch (solid.shape) {
    case 'plane':
      return { body: null, floor: solid.normal[1] > FLOOR_COSINE ? solid.point_m[1] : null };
    case 'sphere': {
      const centre = new Vector3(...solid.centre_m);
      const half = new Vector3().setScalar(solid.radius_m);
      const body = {
        form: `sphere ${solid.radius_m}`,
        centre: solid.centre_m,
        box: new Box3(centre.clone().sub(half), centre.clone().add(half)),
        build: () => new SphereGeometry(DRAWN * solid.radius_m, 64, 40),
      };
      return { body, floor: null };
    }
  }
}

/** Bodies of those solids that have one. */
export function bodiesOf(solids: readonly Collider[]): SolidBody[] {
  return solids.map((solid) => lookOf(solid).body).filter((body) => body !== null);
}
