// The hand: which vertex it holds and where it wants it, by pointer or by keyboard.
import { Matrix4, type PerspectiveCamera, Plane, Raycaster, Vector2, Vector3 } from 'three';
import type { Triple } from '../bindings/geometry';
import { nearestSeen, pick } from './pick';

/** A press beside the cloth takes the vertex that is seen nearest, within this [CSS pixels]. */
const REACH_PX = 24;

/** How far one key press moves the hand, as a part of its distance from the eye. */
const KEY_REACH = 0.02;

/** A part of the page [CSS pixels]. */
export type Box = Pick<DOMRect, 'left' | 'top' | 'width' | 'height'>;

export interface HandEvents {
  /** The box of the picture at this point of the page; null asks for the one that keys act on. */
  picture(at: { x: number; y: number } | null): () => Box;
  /** True when a press there is used up otherwise. */
  press?(vertex: number): boolean;
  grab(vertex: number): void;
  move(target: Triple): void;
  release(): void;
  /** A vertex to take by keyboard when none lies in the middle of the picture. */
  fallbackVertex(): number;
  /** The cloth in the picture that was last asked for. */
  cloth(): { positions: Float32Array; triangles: Uint32Array };
  /** Nothing is pulled below this height [m], whether the scene has a solid floor or not. */
  floor(): number;
  onChange(): void;
}

/** Moves a place to the right, up and away as the viewer sees it, for one key press. */
export function stepSeen(
  camera: PerspectiveCamera,
  place: Vector3,
  [right, up, away]: Triple,
): Vector3 {
  const reach = KEY_REACH * camera.position.distanceTo(place);
  const axis = (index: number) => new Vector3().setFromMatrixColumn(camera.matrixWorld, index);
  return place
    .addScaledVector(axis(0), right * reach)
    .addScaledVector(axis(1), up * reach)
    .addScaledVector(axis(2), -away * reach);
}

/** The vertex that the hand holds and where it wants it. */
class Grip {
  readonly target = new Vector3();
  vertex: number | null = null;
  /** The pointer that holds it; null for a key. */
  pointerId: number | null = null;
  private readonly raycaster = new Raycaster();
  private readonly plane = new Plane();
  private readonly offset = new Vector3(); // the held vertex from the point under the pointer
  private box: () => Box;

  constructor(
    private readonly camera: PerspectiveCamera,
    private readonly events: HandEvents,
  ) {
    this.box = events.picture(null);
  }

  /** Takes the vertex at a point of the page; false when there is none, or when it is used otherwise. */
  takeAt(x: number, y: number): boolean {
    this.box = this.events.picture({ x, y });
    const hit = this.hitAt(x, y);
    const vertex = hit?.vertex ?? this.vertexNear(x, y);
    if (vertex === null || this.events.press?.(vertex)) return false;
    this.take(vertex, hit ? new Vector3(...hit.point) : this.place(vertex));
    return true;
  }

  /** True when a press at this point of the page would take something. */
  reaches(x: number, y: number): boolean {
    this.box = this.events.picture({ x, y });
    return this.vertexNear(x, y) !== null || this.hitAt(x, y) !== null;
  }

  /** Takes what is in the middle of the picture. */
  takeMiddle(): void {
    this.box = this.events.picture(null);
    const { left, top, width, height } = this.box();
    const hit = this.hitAt(left + width / 2, top + height / 2);
    const vertex = hit?.vertex ?? this.events.fallbackVertex();
    this.take(vertex, this.place(vertex));
  }

  /** Goes along with a pointer. */
  moveTo(x: number, y: number): void {
    this.aim(x, y);
    if (!this.raycaster.ray.intersectPlane(this.plane, this.target)) return;
    this.target.add(this.offset);
    this.send();
  }

  nudge(...direction: Triple): void {
    stepSeen(this.camera, this.target, direction);
    this.send();
  }

  release(): void {
    if (this.vertex === null) return;
    this.drop();
    this.events.release();
    this.events.onChange();
  }

  drop(): void {
    this.vertex = null;
    this.pointerId = null;
  }

  private aim(clientX: number, clientY: number): void {
    const box = this.box();
    const x = (2 * (clientX - box.left)) / box.width - 1;
    const y = 1 - (2 * (clientY - box.top)) / box.height;
    this.raycaster.setFromCamera(new Vector2(x, y), this.camera);
  }

  private hitAt(x: number, y: number) {
    this.aim(x, y);
    const { origin, direction } = this.raycaster.ray;
    const { positions, triangles } = this.events.cloth();
    return pick(positions, triangles, origin.toArray(), direction.toArray());
  }

  private vertexNear(x: number, y: number): number | null {
    const { camera } = this;
    const { left, top, width, height } = this.box();
    const view = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    const picture = { matrix: view.elements, width, height };
    const at = { x: x - left, y: y - top };
    return nearestSeen(this.events.cloth().positions, picture, at, REACH_PX);
  }

  private place(vertex: number): Vector3 {
    return new Vector3().fromArray(this.events.cloth().positions, 3 * vertex);
  }

  /** The hand moves in the plane through `depth` that faces the camera. */
  private take(vertex: number, depth: Vector3): void {
    this.vertex = vertex;
    this.target.copy(this.place(vertex));
    this.plane.setFromNormalAndCoplanarPoint(this.camera.getWorldDirection(new Vector3()), depth);
    const under = this.raycaster.ray.intersectPlane(this.plane, new Vector3()) ?? depth;
    this.offset.copy(this.target).sub(under);
    this.events.grab(vertex);
    this.send();
  }

  private send(): void {
    const { target, events } = this;
    target.y = Math.max(target.y, events.floor());
    events.move([target.x, target.y, target.z]);
    events.onChange();
  }
}

/** The pointer's shape tells where a press takes the cloth: asked once a picture at most. */
function showReach(element: HTMLElement, grip: Grip): void {
  let asked = 0;
  element.addEventListener('pointermove', ({ pointerType, buttons, clientX, clientY }) => {
    if (pointerType !== 'mouse' || buttons !== 0) return;
    cancelAnimationFrame(asked);
    asked = requestAnimationFrame(() => {
      const isFree = grip.vertex === null;
      element.classList.toggle('graspable', isFree && grip.reaches(clientX, clientY));
    });
  });
}

/** Has one pointer take, move and let go. */
function listenToPointer(element: HTMLElement, grip: Grip): void {
  element.addEventListener('pointerdown', (event) => {
    if (grip.vertex !== null || event.button !== 0 || event.shiftKey) return;
    if (!grip.takeAt(event.clientX, event.clientY)) return;
    grip.pointerId = event.pointerId;
    element.setPointerCapture(event.pointerId);
  });
  element.addEventListener('pointermove', (event) => {
    if (grip.vertex === null || event.pointerId !== grip.pointerId) return;
    grip.moveTo(event.clientX, event.clientY);
  });
  for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) {
    element.addEventListener(end, (event) => {
      if (event.pointerId === grip.pointerId) grip.release();
    });
  }
  element.addEventListener('blur', () => grip.release());
}

export function createHand(element: HTMLElement, camera: PerspectiveCamera, events: HandEvents) {
  const grip = new Grip(camera, events);
  listenToPointer(element, grip);
  showReach(element, grip);
  const release = () => grip.release();
  const heldKeys: Record<string, () => void> = {
    ArrowLeft: () => grip.nudge(-1, 0, 0),
    ArrowRight: () => grip.nudge(1, 0, 0),
    ArrowUp: () => grip.nudge(0, 1, 0),
    ArrowDown: () => grip.nudge(0, -1, 0),
    PageUp: () => grip.nudge(0, 0, 1),
    PageDown: () => grip.nudge(0, 0, -1),
    Escape: release,
    g: release,
  };
  const freeKeys: Record<string, () => void> = { g: () => grip.takeMiddle() };

  return {
    /** The held vertex, or null. */
    vertex: () => grip.vertex,
    /** Place at which the hand wants the vertex [m]. */
    target: () => grip.target,
    /** True when the key was the hand's: G takes and lets go, arrows and page keys move while held. */
    key(name: string) {
      const action = (grip.vertex === null ? freeKeys : heldKeys)[name];
      action?.();
      return action !== undefined;
    },
    /** Lets go without telling anyone: the cloth is another one. */
    drop() {
      grip.drop();
      events.onChange();
    },
  };
}

export type Hand = ReturnType<typeof createHand>;
