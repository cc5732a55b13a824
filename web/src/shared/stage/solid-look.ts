// How stages show solids: the one place that tells them apart.
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  Matrix4,
  Quaternion,
  SphereGeometry,
  Vector3,
} from 'three';
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

/** A ball whose halves are drawn apart: the band below its equator is the side. */
function capsuleGeometry(axis: Vector3, radius: number): BufferGeometry {
  const length = axis.length();
  const up = new Vector3(0, 1, 0);
  const turn = new Quaternion().setFromUnitVectors(up, length ? axis.clone().normalize() : up);
  const geometry = new SphereGeometry(radius, 64, 48);
  const places = geometry.getAttribute('position');
  for (let i = 0; i < places.count; ++i) {
    const y = places.getY(i);
    places.setY(i, y + (y < 0 ? -length : length) / 2);
  }
  return geometry.applyQuaternion(turn);
}

/** Each triangle has a normal of its own: edges stay sharp. */
function meshGeometry(positions: Float32Array, triangles: Uint32Array): BufferGeometry {
  const geometry = new BufferGeometry()
    .setAttribute('position', new BufferAttribute(positions, 3))
    .setIndex(new BufferAttribute(triangles, 1))
    .toNonIndexed();
  geometry.computeVertexNormals();
  return geometry;
}

/** Corners of the triangles of a box, by bits: 1 is ahead along x, 2 along y, 4 along z. */
const BOX_CORNERS = '023031457476015054267273046062137175';

function boxGeometry(size: Triple): BufferGeometry {
  const corners = Array.from({ length: 8 }, (_, k) =>
    size.map((side, axis) => (((k >> axis) & 1) - 0.5) * side),
  );
  return meshGeometry(
    new Float32Array(corners.flat()),
    new Uint32Array([...BOX_CORNERS].map(Number)),
  );
}

/** Whole micrometres are the same wherever it is, so that one that moves is not built anew. */
const micrometres = (axis: Vector3) => axis.toArray().map((part) => Math.round(1e6 * part));

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
    case 'box': {
      const x = new Vector3(...solid.x_direction);
      const y = new Vector3(...solid.y_direction);
      const turn = new Matrix4().makeBasis(x, y, x.clone().cross(y));
      const build = () => boxGeometry(solid.size_m).applyMatrix4(turn).scale(DRAWN, DRAWN, DRAWN);
      const box = new Box3()
        .setFromCenterAndSize(new Vector3(), new Vector3(...solid.size_m))
        .applyMatrix4(turn)
        .translate(new Vector3(...solid.centre_m));
      const body = {
        form: `box ${solid.size_m} ${micrometres(x)} ${micrometres(y)}`,
        centre: solid.centre_m,
        box,
        build,
      };
      return { body, floor: null };
    }
    case 'mesh': {
      const { id, positions, triangles } = solid.surface;
      const box = new Box3().setFromArray(positions).translate(new Vector3(...solid.offset_m));
      const build = () => meshGeometry(positions, triangles);
      return { body: { form: `mesh ${id}`, centre: solid.offset_m, box, build }, floor: null };
    }
    case 'capsule': {
      const [a, b] = [new Vector3(...solid.a_m), new Vector3(...solid.b_m)];
      const middle = a.clone().lerp(b, 0.5);
      const axis = b.clone().sub(a);
      const body = {
        form: `capsule ${solid.radius_m} ${micrometres(axis)}`,
        centre: middle.toArray(),
        box: new Box3().setFromPoints([a, b]).expandByScalar(solid.radius_m),
        build: () => capsuleGeometry(axis, DRAWN * solid.radius_m),
      };
      return { body, floor: null };
    }
  }
}

/** Bodies of those solids that have one. */
export function bodiesOf(solids: readonly Collider[]): SolidBody[] {
  return solids.map((solid) => lookOf(solid).body).filter((body) => body !== null);
}
