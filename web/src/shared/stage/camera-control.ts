// Orbit, pan and zoom about the scene by mouse, touch and keyboard. The scene stays in view: the
// distance and the turning point are kept within bounds of the framed sphere.
import { type PerspectiveCamera, Spherical, Vector3 } from 'three';

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

export interface CameraControl {
  frame(view: View): void;
  home(): void;
  /** Goes along with what has to be seen, which is there now; the viewer's own turns stay. */
  follow(centre: Vector3): void;
  /** True when the key was one of the camera's. */
  key(name: string): boolean;
  /** While resting, pointers do nothing: a hand is holding the cloth. */
  setResting(isResting: boolean): void;
  /** Call after the canvas changed its shape. */
  refit(): void;
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

/** `pictureHeight` is that of what the camera sees [CSS pixels]. */
export function createCameraControl(
  element: HTMLElement,
  camera: PerspectiveCamera,
  onChange: () => void,
  pictureHeight: () => number = () => element.clientHeight,
): CameraControl {
  const target = new Vector3();
  const pose = new Spherical(1, 1.3, 0.5);
  const pointers = new Map<number, { x: number; y: number }>();
  let view: View = { centre: new Vector3(), radius: 1, azimuth: 0.5, polar: 1.3 };
  let isResting = false;
  let zoom = 1; // distance over the distance that just shows everything

  function fittingDistance(): number {
    const half = (camera.fov * Math.PI) / 360;
    const halfAcross = Math.atan(Math.tan(half) * camera.aspect);
    const { radius, upright = 1 } = view;
    return Math.max((upright * radius) / Math.sin(half), radius / Math.sin(halfAcross));
  }

  function apply(): void {
    pose.phi = clamp(pose.phi, HIGHEST, LOWEST);
    zoom = clamp(zoom, 0.15, 2.5);
    pose.radius = zoom * fittingDistance();
    target.sub(view.centre).clampLength(0, view.radius).add(view.centre);
    camera.position.setFromSpherical(pose).add(target);
    camera.lookAt(target);
    camera.near = pose.radius / 100;
    camera.far = pose.radius * 20;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    onChange();
  }

  function turn(azimuth: number, polar: number): void {
    pose.theta += azimuth;
    pose.phi += polar;
    apply();
  }

  function pan(dx: number, dy: number): void {
    const metresPerPixel =
      (2 * pose.radius * Math.tan((camera.fov * Math.PI) / 360)) / pictureHeight();
    const right = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0);
    const up = new Vector3().setFromMatrixColumn(camera.matrixWorld, 1);
    target.addScaledVector(right, -dx * metresPerPixel).addScaledVector(up, dy * metresPerPixel);
    apply();
  }

  function home(): void {
    target.copy(view.centre);
    pose.theta = view.azimuth;
    pose.phi = view.polar;
    zoom = 1;
    apply();
  }

  function movePinch(moved: { x: number; y: number }, x: number, y: number): void {
    const other = [...pointers.values()].find((pointer) => pointer !== moved);
    if (!other) return;
    const before = Math.hypot(moved.x - other.x, moved.y - other.y);
    const after = Math.hypot(x - other.x, y - other.y);
    if (before > 0 && after > 0) zoom *= before / after;
    pan((x - moved.x) / 2, (y - moved.y) / 2);
  }

  element.addEventListener('pointerdown', (event) => {
    if (isResting) return;
    element.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  element.addEventListener('pointermove', (event) => {
    const pointer = pointers.get(event.pointerId);
    if (!pointer || isResting) return;
    const dx = event.clientX - pointer.x;
    const dy = event.clientY - pointer.y;
    const isPanning = event.shiftKey || (event.buttons & 6) !== 0;
    if (pointers.size > 1) movePinch(pointer, event.clientX, event.clientY);
    else if (isPanning) pan(dx, dy);
    else turn(-dx * DRAG_TURN, -dy * DRAG_TURN);
    pointer.x = event.clientX;
    pointer.y = event.clientY;
  });
  for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) {
    element.addEventListener(end, (event) => pointers.delete(event.pointerId));
  }
  element.addEventListener('contextmenu', (event) => event.preventDefault());
  element.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      zoom *= Math.exp(clamp(event.deltaY, -100, 100) * 0.002);
      apply();
    },
    { passive: false },
  );

  const keys: Record<string, () => void> = {
    ArrowLeft: () => turn(-KEY_TURN, 0),
    ArrowRight: () => turn(KEY_TURN, 0),
    ArrowUp: () => turn(0, -KEY_TURN),
    ArrowDown: () => turn(0, KEY_TURN),
    '+': () => zoomBy(1 / KEY_ZOOM),
    '=': () => zoomBy(1 / KEY_ZOOM),
    '-': () => zoomBy(KEY_ZOOM),
    Home: home,
  };
  function zoomBy(factor: number): void {
    zoom *= factor;
    apply();
  }

  return {
    frame(newView) {
      view = newView;
      home();
    },
    home,
    follow(centre) {
      const moved = centre.clone().sub(view.centre);
      target.add(moved);
      view = { ...view, centre: centre.clone() };
      apply();
    },
    key(name) {
      const action = keys[name];
      action?.();
      return action !== undefined;
    },
    setResting(value) {
      isResting = value;
      pointers.clear();
    },
    refit: apply,
  };
}
