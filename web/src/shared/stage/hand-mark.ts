// A mark on the held vertex, and the thread to where the hand wants it.
import {
  BufferAttribute,
  BufferGeometry,
  type Camera,
  DynamicDrawUsage,
  Group,
  Line,
  LineBasicMaterial,
  Mesh,
  MeshBasicMaterial,
  SphereGeometry,
  type Vector3,
} from 'three';

/** Radius of the marker, as a part of its distance: some 6 pixels on a screen. */
const MARKER_RADIUS = 0.006;

export function createHandMark() {
  const seen = { depthTest: false, transparent: true };
  const marker = new Mesh(new SphereGeometry(1, 20, 14), new MeshBasicMaterial(seen));
  const thread = new Line(new BufferGeometry(), new LineBasicMaterial(seen));
  const threadEnds = new BufferAttribute(new Float32Array(6), 3).setUsage(DynamicDrawUsage);
  thread.geometry.setAttribute('position', threadEnds);
  const object = new Group();
  object.add(marker, thread);
  object.visible = false;
  for (const part of object.children) {
    part.frustumCulled = false;
    part.renderOrder = 10;
  }
  return {
    object,
    /** Null hides it. */
    place(held: Vector3 | null, target: Vector3, camera: Camera) {
      object.visible = held !== null;
      if (!held) return;
      marker.position.copy(held);
      marker.scale.setScalar(MARKER_RADIUS * camera.position.distanceTo(held));
      held.toArray(threadEnds.array, 0);
      target.toArray(threadEnds.array, 3);
      threadEnds.needsUpdate = true;
    },
    setColour(colour: string) {
      marker.material.color.set(colour);
      thread.material.color.set(colour);
    },
  };
}
