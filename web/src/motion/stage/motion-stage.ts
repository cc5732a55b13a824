// The picture: renderer, camera, light, cloth, hand. It gets frames and settings, never the
// simulation, and draws only when something changed.
import { Box3, PerspectiveCamera, Scene, Sphere, Vector3, type WebGLRenderer } from 'three';
import type { Scalar } from '../../shared/bindings/frame';
import type { Collider, Triple } from '../../shared/bindings/geometry';
import { lookOf } from '../../shared/fabric/fabric-look';
import { createCameraControl } from '../../shared/stage/camera-control';
import { createCanvas } from '../../shared/stage/canvas';
import { createClothMesh } from '../../shared/stage/cloth-mesh';
import { createHand } from '../../shared/stage/grab';
import { createHandMark } from '../../shared/stage/hand-mark';
import type { HeatMap, HeatScale } from '../../shared/stage/heat-map';
import { createSurroundings } from '../../shared/stage/surroundings';

export interface MotionStageEvents {
  grab(vertex: number): void;
  moveGrab(target: Triple): void;
  releaseGrab(): void;
  /** Keys that are neither the camera's nor the hand's. True when used. */
  key(name: string): boolean;
  /** After each drawn frame: the heat map's scale, and the invitation's place in pixels. */
  drawn(scale: HeatScale, invitation: { x: number; y: number }): void;
  contextLost(): void;
}

export interface MotionStage {
  /** A new mesh; the view is set anew when it belongs to a new scene. */
  showMesh(triangles: Uint32Array, nVertices: number, isNewScene: boolean): void;
  showFrame(buffer: ArrayBuffer, scalar: Scalar): void;
  setColliders(colliders: Collider[]): void;
  setFabric(id: number): void;
  setHeat(map: HeatMap, range: 'auto' | number): void;
  setEdges(isShown: boolean): void;
  homeView(): void;
  /** Present positions, three numbers a vertex [m]. */
  positions(): Float32Array;
  /** Where a vertex is seen, in pixels from the canvas's upper left corner. */
  project(vertex: number): { x: number; y: number };
  /** The vertex that asks to be taken. */
  inviting(): number;
}

/** Direction of the first view [rad]: a little from the right and from above. */
const AZIMUTH = 0.55;
const POLAR = 1.32;

/** A cloth lower than this part of its width lies level: let go, it will swing or fall. */
const LEVEL_HEIGHT = 0.25;
/** A sheet that swings from its edge hangs almost its length below it; its free edge whips past. */
const SWING_BELOW = 0.8;
const SWING_AROUND = 0.15;

/** A plane tilted by less than 8 degrees, as a cosine, is a floor. */
const FLOOR_COSINE = 0.99;

/** A metre lower counts for the invitation as much as two metres nearer: free corners hang low. */
const LOW_OVER_NEAR = 2;

/** What has to stay in view: where the cloth is, where it can swing to, and the bodies. */
function framedSphere(positions: Float32Array, colliders: Collider[]): Sphere {
  const box = new Box3().setFromArray(positions);
  const reach = box.getSize(new Vector3());
  const across = Math.max(reach.x, reach.z);
  if (
    reach.y < LEVEL_HEIGHT * across &&
    colliders.every((collider) => collider.shape === 'plane')
  ) {
    box.min.y -= SWING_BELOW * across;
    box.expandByVector(new Vector3(SWING_AROUND * across, 0, SWING_AROUND * across));
  }
  for (const collider of colliders) {
    if (collider.shape !== 'sphere') continue;
    const centre = new Vector3(...collider.centre);
    const half = new Vector3().setScalar(collider.radius_m);
    box.union(new Box3(centre.clone().sub(half), centre.clone().add(half)));
  }
  return box.getBoundingSphere(new Sphere());
}

/** The floor is the level plane of the scene, or a little under everything that is seen [m]. */
function floorHeight(sphere: Sphere, colliders: Collider[]): number {
  for (const collider of colliders) {
    if (collider.shape === 'plane' && collider.normal[1] > FLOOR_COSINE) return collider.point[1];
  }
  return Math.min(0, sphere.center.y - sphere.radius);
}

/** The vertex that asks to be taken: low, and on the side of the eye. */
function invitingVertex(positions: Float32Array, towards: Vector3): number {
  let best = 0;
  let bestScore = Number.NEGATIVE_INFINITY;
  const place = new Vector3();
  for (let v = 0; 3 * v < positions.length; ++v) {
    place.fromArray(positions, 3 * v);
    const score = place.dot(towards) - LOW_OVER_NEAR * place.y;
    if (score > bestScore) {
      bestScore = score;
      best = v;
    }
  }
  return best;
}

/** Draws into `canvas`, which fills `parent`. Throws when the browser has no WebGL 2. */
export function createMotionStage(
  parent: HTMLElement,
  canvas: HTMLCanvasElement,
  events: MotionStageEvents,
): MotionStage {
  const scene = new Scene();
  const camera = new PerspectiveCamera(32, 1, 0.01, 100);
  const cloth = createClothMesh();
  const surroundings = createSurroundings();
  const mark = createHandMark();
  scene.add(surroundings.object, cloth.object, mark.object);

  let colliders: Collider[] = [];
  let awaitsFraming = false;
  let isFreshMesh = false;
  let inviting = 0;
  let floor = 0; // height of what is drawn as the floor [m]

  const { redraw, open } = createCanvas(parent, canvas, {
    draw,
    resized(width, height) {
      camera.aspect = width / height;
      control.refit();
    },
    themed(colour) {
      surroundings.setTheme(colour);
      mark.setColour(colour('--stage-hand'));
    },
    key: (name) => hand.key(name) || control.key(name) || events.key(name),
    contextLost: events.contextLost,
  });
  const control = createCameraControl(canvas, camera, redraw);
  const hand = createHand(canvas, camera, {
    grab(vertex) {
      control.setResting(true);
      events.grab(vertex);
    },
    move: events.moveGrab,
    release() {
      control.setResting(false);
      events.releaseGrab();
    },
    fallbackVertex: () => inviting,
    picture: () => () => canvas.getBoundingClientRect(),
    cloth: () => ({ positions: cloth.positions(), triangles: cloth.triangles() }),
    floor: () => floor,
    onChange: redraw,
  });

  function project(vertex: number): { x: number; y: number } {
    const place = new Vector3().fromArray(cloth.positions(), 3 * vertex).project(camera);
    return {
      x: ((place.x + 1) / 2) * canvas.clientWidth,
      y: ((1 - place.y) / 2) * canvas.clientHeight,
    };
  }

  function draw(renderer: WebGLRenderer): void {
    if (cloth.positions().length === 0) return;
    cloth.update();
    const vertex = hand.vertex();
    const held = vertex === null ? null : new Vector3().fromArray(cloth.positions(), 3 * vertex);
    mark.place(held, hand.target(), camera);
    renderer.render(scene, camera);
    events.drawn(cloth.heatScale(), project(inviting));
  }

  function frameScene(): void {
    const sphere = framedSphere(cloth.positions(), colliders);
    floor = floorHeight(sphere, colliders);
    surroundings.frame(sphere.center, sphere.radius, floor);
    control.frame({ centre: sphere.center, radius: sphere.radius, azimuth: AZIMUTH, polar: POLAR });
    chooseInviting();
  }

  function chooseInviting(): void {
    const towards = camera.getWorldDirection(new Vector3()).negate();
    inviting = invitingVertex(cloth.positions(), towards);
  }

  open();

  return {
    showMesh(triangles, nVertices, isNewScene) {
      cloth.setTopology(triangles, nVertices);
      awaitsFraming = isNewScene;
      isFreshMesh = true;
      hand.drop();
      control.setResting(false);
    },
    showFrame(buffer, scalar) {
      cloth.setFrame(buffer, scalar);
      if (isFreshMesh) chooseInviting();
      isFreshMesh = false;
      redraw();
    },
    setColliders(newColliders) {
      colliders = newColliders;
      surroundings.setColliders(newColliders);
      if (awaitsFraming) {
        awaitsFraming = false;
        frameScene();
      }
      redraw();
    },
    setFabric(id) {
      cloth.setLook(lookOf(id));
      redraw();
    },
    setHeat(map, range) {
      if (cloth.setHeat(map, range)) redraw();
    },
    setEdges(isShown) {
      cloth.setEdges(isShown);
      redraw();
    },
    homeView: control.home,
    positions: () => cloth.positions(),
    project,
    inviting: () => inviting,
  };
}
