// Where the cloth is held: a ball at each handle, a pin at each pin. Seen through the cloth.
import {
  type Camera,
  ConeGeometry,
  Group,
  Mesh,
  MeshBasicMaterial,
  SphereGeometry,
  Vector3,
} from 'three';
import type { Triple } from '../../shared/bindings/geometry';

export interface HoldMark {
  kind: 'pin' | 'handle';
  /** Its middle [m]. */
  place: Triple;
  /** The one that keys move. */
  isChosen: boolean;
}

/** A part of the distance: some 5 pixels on a screen. */
const RADIUS = 0.0055;

/** Stands on its tip. */
function pinGeometry(): ConeGeometry {
  const geometry = new ConeGeometry(1, 3, 20);
  geometry.rotateX(Math.PI);
  geometry.translate(0, 1.5, 0);
  return geometry;
}

export function createHoldMarks() {
  const object = new Group();
  const geometries = { pin: pinGeometry(), handle: new SphereGeometry(1, 20, 14) };
  const seen = { depthTest: false, transparent: true, toneMapped: false };
  const materials = {
    pin: new MeshBasicMaterial(seen),
    handle: new MeshBasicMaterial(seen),
    chosen: new MeshBasicMaterial(seen),
  };
  const eye = new Vector3();
  return {
    object,
    set(marks: readonly HoldMark[]) {
      object.clear();
      for (const { kind, place, isChosen } of marks) {
        const mark = new Mesh(geometries[kind], materials[isChosen ? 'chosen' : kind]);
        mark.position.set(...place);
        mark.renderOrder = 9;
        mark.frustumCulled = false;
        object.add(mark);
      }
    },
    /** Gives all marks their size on the screen. */
    face(camera: Camera) {
      eye.setFromMatrixPosition(camera.matrixWorld);
      for (const mark of object.children) {
        mark.scale.setScalar(RADIUS * eye.distanceTo(mark.position));
      }
    },
    setColours(colours: Record<HoldMark['kind'] | 'chosen', string>) {
      for (const kind of ['pin', 'handle', 'chosen'] as const) {
        materials[kind].color.set(colours[kind]);
      }
    },
  };
}
