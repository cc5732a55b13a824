// Orbit, pan and zoom about the scene by mouse, touch and keyboard. The scene stays in view: the
// distance and the turning point are kept within bounds of the framed sphere.
import { type PerspectiveCamera, Spherical, Vector3 } from 'three';
import type { Triple } from '../bindings/geometry';

/** Turn for one key press, and for a drag across one pixel [rad]. */
const KEY_TURN = 0.12;
const DRAG_TURN = 0.006;
const KEY_ZOOM = 1.15;
/** Polar angle from straight above: never quite on the pole, and not far below the floor's level. */
const HIGHEST = 0.08;
const LOWEST = 1.62;

export interface View {
  /** Centre [m] and radius [m] of what has to be seen. */
  centre: Vector3;
  radius: number;
  /** Directions from which it is seen at first [rad]. */
  azimuth: number;
  polar: number;
  /** How much of the distance that shows the whole ball, height by height, is enough; 1 if unsaid. */
  upright?: number;
}

/** The place from which the framed scene is seen, when that is not the first one. */
export interface Pose {
  /** [rad] */
  azimuth: number;
  polar: number;
  /** Distance, where 1 is the one that just shows everything. */
  zoom: number;
  /** The turning point from the centre, in radii of what has to be seen. */
  shift: Triple;
}

function clamp(value: number, low: number, high: number): number {
  return Math.min(high, Math.max(low, value));
}

/** Room above and below what has to be seen, for a name and for the marks of pins. */
const MARGIN = 1.08;

/**
 * `View.upright` for places within the ball, three numbers each [m]. With half the angle of view a,
 * a place u above or below the line of sight and t towards the eye is just seen from the
 * distance u / tan a + t, the whole ball from radius / sin a. `fov` is the angle of view [degrees].
 */
export function uprightOf(places: readonly number[], view: View, fov: number): number {
  const half = (fov * Math.PI) / 360;
  const towards = new Vector3().setFromSphericalCoords(1, view.polar, view.azimuth);
  const up = new Vector3(0, 1, 0).addScaledVector(towards, -towards.y).normalize();
  const place = new Vector3();
  let most = 0;
  for (let k = 0; k + 2 < places.length; k += 3) {
    place.fromArray(places, k).sub(view.centre);
    const above = Math.abs(place.dot(up)) * Math.cos(half);
    most = Math.max(most, above + place.dot(towards) * Math.sin(half));
  }
  return Math.min(1, (MARGIN * most) / view.radius);
}

/** The camera's place: about a turning point, at a distance in which the view is seen. */
class Orbit {
  private readonly target = new Vector3();
  private readonly pose = new Spherical(1, 1.3, 0.5);
  private view: View = { centre: new Vector3(), radius: 1, azimuth: 0.5, polar: 1.3 };
  private zoom = 1; // distance over the distance that just shows everything

  constructor(
    private readonly camera: PerspectiveCamera,
    private readonly onChange: () => void,
    private readonly pictureHeight: () => number,
  ) {}

  frame(view: View): void {
    this.view = view;
    this.home();
  }

  home(): void {
    this.target.copy(this.view.centre);
    this.pose.theta = this.view.azimuth;
    this.pose.phi = this.view.polar;
    this.zoom = 1;
    this.apply();
  }

  /** Null at home. */
  held(): Pose | null {
    const { pose, target, view, zoom } = this;
    const shift = target.clone().sub(view.centre).divideScalar(view.radius);
    const isTurned = pose.theta !== view.azimuth || pose.phi !== clamp(view.polar, HIGHEST, LOWEST);
    if (!isTurned && zoom === 1 && shift.lengthSq() < 1e-12) return null;
    return { azimuth: pose.theta, polar: pose.phi, zoom, shift: shift.toArray() };
  }

  hold({ azimuth, polar, zoom, shift }: Pose): void {
    const { pose, target, view } = this;
    target.fromArray(shift).multiplyScalar(view.radius).add(view.centre);
    pose.theta = azimuth;
    pose.phi = polar;
    this.zoom = zoom;
    this.apply();
  }

  follow(centre: Vector3): void {
    this.target.add(centre.clone().sub(this.view.centre));
    this.view = { ...this.view, centre: centre.clone() };
    this.apply();
  }

  turn(azimuth: number, polar: number): void {
    this.pose.theta += azimuth;
    this.pose.phi += polar;
    this.apply();
  }

  zoomBy(factor: number): void {
    this.zoom *= factor;
    this.apply();
  }

  /** Shifts what is seen by a way on the screen [CSS pixels]. */
  pan(dx: number, dy: number): void {
    const { camera, pose, target } = this;
    const metresPerPixel =
      (2 * pose.radius * Math.tan((camera.fov * Math.PI) / 360)) / this.pictureHeight();
    const right = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0);
    const up = new Vector3().setFromMatrixColumn(camera.matrixWorld, 1);
    target.addScaledVector(right, -dx * metresPerPixel).addScaledVector(up, dy * metresPerPixel);
    this.apply();
  }

  apply(): void {
    const { camera, pose, target, view } = this;
    pose.phi = clamp(pose.phi, HIGHEST, LOWEST);
    this.zoom = clamp(this.zoom, 0.15, 2.5);
    pose.radius = this.zoom * this.fittingDistance();
    target.sub(view.centre).clampLength(0, view.radius).add(view.centre);
    camera.position.setFromSpherical(pose).add(target);
    camera.lookAt(target);
    camera.near = pose.radius / 100;
    camera.far = pose.radius * 20;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    this.onChange();
  }

  private fittingDistance(): number {
    const half = (this.camera.fov * Math.PI) / 360;
    const halfAcross = Math.atan(Math.tan(half) * this.camera.aspect);
    const { radius, upright = 1 } = this.view;
    return Math.max((upright * radius) / Math.sin(half), radius / Math.sin(halfAcross));
  }
}

interface Point {
  x: number;
  y: number;
}

/** Pointers that turn, pan and zoom; none does anything while resting. */
class OrbitPointers {
  private readonly pointers = new Map<number, Point>();
  private isResting = false;

  constructor(
    element: HTMLElement,
    private readonly orbit: Orbit,
  ) {
    element.addEventListener('pointerdown', ({ pointerId, clientX: x, clientY: y }) => {
      if (this.isResting) return;
      element.setPointerCapture(pointerId);
      this.pointers.set(pointerId, { x, y });
    });
    element.addEventListener('pointermove', (event) => this.move(event));
    for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) {
      element.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
    }
    element.addEventListener('contextmenu', (event) => event.preventDefault());
    const wheel = (event: WheelEvent) => {
      event.preventDefault();
      orbit.zoomBy(Math.exp(clamp(event.deltaY, -100, 100) * 0.002));
    };
    element.addEventListener('wheel', wheel, { passive: false });
  }

  setResting(isResting: boolean): void {
    this.isResting = isResting;
    this.pointers.clear();
  }

  private move({ pointerId, clientX, clientY, shiftKey, buttons }: PointerEvent): void {
    const pointer = this.pointers.get(pointerId);
    if (!pointer || this.isResting) return;
    const dx = clientX - pointer.x;
    const dy = clientY - pointer.y;
    const isPanning = shiftKey || (buttons & 6) !== 0;
    if (this.pointers.size > 1) this.pinch(pointer, clientX, clientY);
    else if (isPanning) this.orbit.pan(dx, dy);
    else this.orbit.turn(-dx * DRAG_TURN, -dy * DRAG_TURN);
    pointer.x = clientX;
    pointer.y = clientY;
  }

  private pinch(moved: Point, x: number, y: number): void {
    const other = [...this.pointers.values()].find((pointer) => pointer !== moved);
    if (!other) return;
    const before = Math.hypot(moved.x - other.x, moved.y - other.y);
    const after = Math.hypot(x - other.x, y - other.y);
    if (before > 0 && after > 0) this.orbit.zoomBy(before / after);
    this.orbit.pan((x - moved.x) / 2, (y - moved.y) / 2);
  }
}

/** `pictureHeight` is that of what the camera sees [CSS pixels]. */
export function createCameraControl(
  element: HTMLElement,
  camera: PerspectiveCamera,
  onChange: () => void,
  pictureHeight: () => number = () => element.clientHeight,
) {
  const orbit = new Orbit(camera, onChange, pictureHeight);
  const pointers = new OrbitPointers(element, orbit);
  const home = () => orbit.home();
  const keys: Record<string, () => void> = {
    ArrowLeft: () => orbit.turn(-KEY_TURN, 0),
    ArrowRight: () => orbit.turn(KEY_TURN, 0),
    ArrowUp: () => orbit.turn(0, -KEY_TURN),
    ArrowDown: () => orbit.turn(0, KEY_TURN),
    '+': () => orbit.zoomBy(1 / KEY_ZOOM),
    '=': () => orbit.zoomBy(1 / KEY_ZOOM),
    '-': () => orbit.zoomBy(KEY_ZOOM),
    Home: home,
  };
  return {
    frame: (view: View) => orbit.frame(view),
    home,
    /** Null for where the scene is seen from at first. */
    pose: () => orbit.held(),
    setPose(pose: Pose | null) {
      if (pose) orbit.hold(pose);
      else orbit.home();
    },
    /** Goes along with what has to be seen, which is there now; the viewer's own turns stay. */
    follow: (centre: Vector3) => orbit.follow(centre),
    /** True when the key was one of the camera's. */
    key(name: string) {
      const action = keys[name];
      action?.();
      return action !== undefined;
    },
    /** While resting, pointers do nothing: a hand is holding the cloth. */
    setResting: (isResting: boolean) => pointers.setResting(isResting),
    /** Call after the canvas changed its shape. */
    refit: () => orbit.apply(),
  };
}
