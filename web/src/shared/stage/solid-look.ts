// How stages show solids: the one place that tells them apart.
import {
  Box3,
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  CapsuleGeometry,
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

function capsuleGeometry(axis: Vector3, radius: number): BufferGeometry {
  const up = new Vector3(0, 1, 0);
  const length = axis.length();
  const turn = new Quaternion();
  if (length > 0) turn.setFromUnitVectors(up, axis.clone().divideScalar(length));
  return new CapsuleGeometry(radius, length, 20, 64).applyQuaternion(turn);
}

/** Each triangle has a normal of its own: edges stay sharp. */
function meshGeometry(positions: Float32Array, triangles: Uint32Array): BufferGeometry {
  const indexed = new BufferGeometry();
  indexed.setAttribute('position', new BufferAttribute(positions, 3));
  indexed.setIndex(new BufferAttribute(triangles, 1));
  const geometry = indexed.toNonIndexed();
  geometry.computeVertexNormals();
  return geometry;
}

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
      const size = new Vector3(...solid.size_m).multiplyScalar(DRAWN);
      const told = [x, y].flatMap((axis) => axis.toArray().map((part) => Math.round(1e6 * part)));
      const build = () => new BoxGeometry(...size.toArray()).applyMatrix4(turn);
      const box = new Box3()
        .setFromCenterAndSize(new Vector3(), new Vector3(...solid.size_m))
        .applyMatrix4(turn)
        .translate(new Vector3(...solid.centre_m));
      const body = { form: `box ${solid.size_m} ${told}`, centre: solid.centre_m, box, build };
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
      const middle = a.clone().add(b).divideScalar(2);
      const axis = b.clone().sub(a);
      // Whole micrometres are the same wherever it is, so that one that moves is not built anew.
      const told = axis.toArray().map((part) => Math.round(1e6 * part));
      const body = {
        form: `capsule ${solid.radius_m} ${told}`,
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
