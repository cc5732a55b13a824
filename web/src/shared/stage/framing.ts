// The first view of a stage: all that the cloth of a scene will need, and its bodies.
import { Box3, Sphere, Vector3 } from 'three';
import type { Collider } from '../bindings/geometry';
import type { PaneStage } from './pane-stage';
import { bodiesOf, lookOf } from './solid-look';

/** Direction of the first view [rad]: a little from the right and from above. */
const AZIMUTH = 0.55;
const POLAR = 1.32;

/** A cloth lower than this part of its width lies level: let go, it will swing or fall. */
const LEVEL_HEIGHT = 0.25;
/** A sheet that swings from its edge hangs almost its length below it; its free edge whips past. */
const SWING_BELOW = 0.8;
const SWING_AROUND = 0.15;

/** A ball around what has to stay in view: where the cloth is, where it can swing to, and the bodies. */
export function framedSphere(positions: Float32Array, colliders: Collider[]): Sphere {
  const box = new Box3().setFromArray(positions);
  const reach = box.getSize(new Vector3());
  const across = Math.max(reach.x, reach.z);
  const bodies = bodiesOf(colliders);
  if (reach.y < LEVEL_HEIGHT * across && bodies.length === 0) {
    box.min.y -= SWING_BELOW * across;
    box.expandByVector(new Vector3(SWING_AROUND * across, 0, SWING_AROUND * across));
  }
  for (const body of bodies) box.union(body.box);
  return box.getBoundingSphere(new Sphere());
}

/** The floor is the level plane of the scene, or a little under everything that is seen [m]. */
export function floorHeight(sphere: Sphere, colliders: Collider[]): number {
  const floors = colliders.map((solid) => lookOf(solid).floor);
  return floors.find((floor) => floor !== null) ?? Math.min(0, sphere.center.y - sphere.radius);
}

/** The floor of the scene, and the view in which all of it is seen. */
export function frame({ surroundings, control }: PaneStage, sphere: Sphere, floor: number): void {
  const { center: centre, radius } = sphere;
  surroundings.frame(centre, radius, floor);
  control.frame({ centre, radius, azimuth: AZIMUTH, polar: POLAR });
}
