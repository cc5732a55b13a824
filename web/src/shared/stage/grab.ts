// The hand: which vertex it holds and where it wants it, by pointer or by keyboard.
import { type PerspectiveCamera, Plane, Raycaster, Vector2, Vector3 } from 'three';
import type { Triple } from '../bindings/geometry';
import { pick } from './pick';

/** How far one key press moves the hand, as a part of its distance from the eye. */
const KEY_REACH = 0.02;

export interface Hand {
  /** The held vertex, or null. */
  vertex(): number | null;
  /** Where the hand wants it [m]. */
  target(): Vector3;
  /** True when the key was the hand's: G takes and lets go, arrows and page keys move while held. */
  key(name: string): boolean;
  /** Lets go without telling anyone: the cloth is another one. */
  drop(): void;
}

/** A part of the page [CSS pixels]. */
export type Box = Pick<DOMRect, 'left' | 'top' | 'width' | 'height'>;

export interface HandEvents {
  /** Of the picture that a point of the page lies in, or of null, that keys are for: where it is. */
  picture(at: { x: number; y: number } | null): () => Box;
  /** True when a press there is used up otherwise. */
  press?(vertex: number): boolean;
  grab(vertex: number): void;
  move(target: Triple): void;
  release(): void;
  /** A vertex to take by keyboard when none lies in the middle of the picture. */
  fallbackVertex(): number;
  /** In the picture that was last asked for. */
  cloth(): { positions: Float32Array; triangles: Uint32Array };
  /** Nothing is pulled below this height [m], whether the scene has a solid floor or not. */
  floor(): number;
  onChange(): void;
}

export function createHand(
  element: HTMLElement,
  camera: PerspectiveCamera,
  events: HandEvents,
): Hand {
  const raycaster = new Raycaster();
  const plane = new Plane();
  const target = new Vector3();
  const offset = new Vector3(); // from the point under the pointer to the held vertex
  let vertex: number | null = null;
  let pointerId: number | null = null;
  let boxNow = events.picture(null);

  function aim(clientX: number, clientY: number): void {
    const box = boxNow();
    const x = (2 * (clientX - box.left)) / box.width - 1;
    const y = 1 - (2 * (clientY - box.top)) / box.height;
    raycaster.setFromCamera(new Vector2(x, y), camera);
  }

  function place(of: number): Vector3 {
    return new Vector3().fromArray(events.cloth().positions, 3 * of);
  }

  function take(newVertex: number, point: Vector3): void {
    vertex = newVertex;
    target.copy(place(newVertex));
    offset.copy(target).sub(point);
    // The hand moves in the plane through the hit that faces the camera.
    plane.setFromNormalAndCoplanarPoint(camera.getWorldDirection(new Vector3()), point);
    events.grab(newVertex);
    send();
  }

  function send(): void {
    target.y = Math.max(target.y, events.floor());
    events.move([target.x, target.y, target.z]);
    events.onChange();
  }

  function release(): void {
    if (vertex === null) return;
    vertex = null;
    pointerId = null;
    events.release();
    events.onChange();
  }

  element.addEventListener('pointerdown', (event) => {
    if (vertex !== null || event.button !== 0 || event.shiftKey) return;
    boxNow = events.picture({ x: event.clientX, y: event.clientY });
    aim(event.clientX, event.clientY);
    const { origin, direction } = raycaster.ray;
    const { positions, triangles } = events.cloth();
    const hit = pick(positions, triangles, origin.toArray(), direction.toArray());
    if (!hit || events.press?.(hit.vertex)) return;
    pointerId = event.pointerId;
    element.setPointerCapture(event.pointerId);
    take(hit.vertex, new Vector3(...hit.point));
  });
  element.addEventListener('pointermove', (event) => {
    if (vertex === null || event.pointerId !== pointerId) return;
    aim(event.clientX, event.clientY);
    if (!raycaster.ray.intersectPlane(plane, target)) return;
    target.add(offset);
    send();
  });
  for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) {
    element.addEventListener(end, (event) => {
      if (event.pointerId === pointerId) release();
    });
  }
  element.addEventListener('blur', release);

  function takeByKey(): void {
    boxNow = events.picture(null);
    const box = boxNow();
    aim(box.left + box.width / 2, box.top + box.height / 2);
    const { origin, direction } = raycaster.ray;
    const { positions, triangles } = events.cloth();
    const hit = pick(positions, triangles, origin.toArray(), direction.toArray());
    const chosen = hit?.vertex ?? events.fallbackVertex();
    take(chosen, place(chosen));
  }

  function nudge(right: number, up: number, away: number): void {
    const reach = KEY_REACH * camera.position.distanceTo(target);
    const axis = (index: number) => new Vector3().setFromMatrixColumn(camera.matrixWorld, index);
    target
      .addScaledVector(axis(0), right * reach)
      .addScaledVector(axis(1), up * reach)
      .addScaledVector(axis(2), -away * reach);
    send();
  }

  const heldKeys: Record<string, () => void> = {
    ArrowLeft: () => nudge(-1, 0, 0),
    ArrowRight: () => nudge(1, 0, 0),
    ArrowUp: () => nudge(0, 1, 0),
    ArrowDown: () => nudge(0, -1, 0),
    PageUp: () => nudge(0, 0, 1),
    PageDown: () => nudge(0, 0, -1),
    Escape: release,
    g: release,
  };

  return {
    vertex: () => vertex,
    target: () => target,
    key(name) {
      const action = vertex === null ? { g: takeByKey }[name] : heldKeys[name];
      action?.();
      return action !== undefined;
    },
    drop() {
      vertex = null;
      pointerId = null;
      events.onChange();
    },
  };
}
