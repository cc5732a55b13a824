// One body that swings, in one energy or in two side by side, and the ghost of the straight way. It gets
// shapes, never the solver, and draws only when something changed.
import { Box3, Sphere } from 'three';
import { FLOATS_PER_VERTEX, frameViews } from '../../shared/bindings/frame';
import { lookOf } from '../../shared/fabric/fabric-look';
import { uprightOf } from '../../shared/stage/camera-control';
import { type ClothMesh, createClothMesh } from '../../shared/stage/cloth-mesh';
import {
  createHeldStage,
  type HeldStageEvents,
  type HeldStageParts,
} from '../../shared/stage/held-stage';
import type { PaneStage } from '../../shared/stage/pane-stage';

export interface ModesStageEvents extends HeldStageEvents {
  drawn: HeldStageParts['drawn'];
}

/** Direction of the first view [rad]. */
const AZIMUTH = 0.42;
const POLAR = 1.12;

/** The floor lies under the body by this part of its size. */
const FLOOR_BELOW = 0.2;

const GHOST_OPACITY = 0.5;

const MOST_PANES = 2;

/** A mesh with a frame of its own, which is written anew for each shape. */
class Shape {
  readonly mesh: ClothMesh = createClothMesh();
  private buffer = new ArrayBuffer(0);

  setTopology(triangles: Uint32Array, nVertices: number): void {
    this.buffer = new ArrayBuffer(4 * FLOATS_PER_VERTEX * nVertices);
    this.mesh.setFrame(new ArrayBuffer(0), 'stretch');
    this.mesh.setTopology(triangles, nVertices);
  }

  set(positions: Float32Array): void {
    frameViews(this.buffer).positions.set(positions);
    this.mesh.setFrame(this.buffer, 'stretch');
  }

  get isThere(): boolean {
    return this.mesh.positions().length > 0;
  }
}

/** Makes a shape that is seen through: it throws no shadow, and hides nothing behind it. */
function makeGhost({ mesh }: Shape, colour: string): void {
  mesh.setLook({
    front: colour,
    back: colour,
    roughness: 1,
    sheen: 0,
    sheenColour: colour,
    opacity: GHOST_OPACITY,
  });
  mesh.object.traverse((part) => {
    part.castShadow = false;
    part.receiveShadow = false;
  });
  mesh.object.renderOrder = 1;
}

/** How far behind the body the ghost stands, in shares of the depth that the body takes up and of its size. */
const BEHIND_DEPTH = 1.15;
const BEHIND_SIZE = 0.16;

/** Room below the body for the invitation's words, in shares of its size. */
const BELOW = 0.08;

/** Shapes of one topology, one in each pane, with the ghost behind the first. */
class Shapes {
  readonly all = Array.from({ length: MOST_PANES }, () => new Shape());
  readonly ghost = new Shape();
  hasGhost = false;
  triangles: Uint32Array = new Uint32Array(0);

  positions(pane: number): Float32Array {
    return this.all[pane]?.mesh.positions() ?? new Float32Array(0);
  }

  setTopology(triangles: Uint32Array, nVertices: number): void {
    this.triangles = triangles;
    for (const shape of [...this.all, this.ghost]) shape.setTopology(triangles, nVertices);
    this.hasGhost = false;
  }

  /** Has what one pane shows be seen. */
  show(pane: number): void {
    this.all.forEach((shape, other) => {
      shape.mesh.object.visible = other === pane && shape.isThere;
    });
    this.ghost.mesh.object.visible = this.hasGhost && pane === 0;
    for (const { mesh } of [...this.all, this.ghost]) if (mesh.object.visible) mesh.update();
  }
}

/** Sets the view so that all is seen; the height of the floor below it [m]. */
function frame(
  { surroundings, control, camera }: PaneStage,
  ghost: Shape,
  keys: readonly number[],
  swings: readonly number[],
): number {
  const { min, max } = new Box3().setFromArray(keys);
  const size = min.distanceTo(max);
  const behind = BEHIND_DEPTH * (max.z - min.z) + BEHIND_SIZE * size;
  ghost.mesh.object.position.z = -behind;
  const all = [...keys, ...swings];
  for (let k = 0; k < keys.length; k += 3)
    all.push(keys[k] ?? 0, keys[k + 1] ?? 0, (keys[k + 2] ?? 0) - behind);
  all.push((min.x + max.x) / 2, min.y - BELOW * size, max.z);
  const whole = new Box3().setFromArray(all);
  const { center: centre, radius } = whole.getBoundingSphere(new Sphere());
  const floor = min.y - FLOOR_BELOW * radius;
  surroundings.frame(centre, radius, floor);
  const view = { centre, radius, azimuth: AZIMUTH, polar: POLAR };
  control.frame({ ...view, upright: uprightOf(all, view, camera.fov) });
  return floor;
}

/** Draws into `canvas`, which fills `parent`. Throws when the browser has no WebGL 2. */
export function createModesStage(
  parent: HTMLElement,
  canvas: HTMLCanvasElement,
  events: ModesStageEvents,
) {
  const shapes = new Shapes();
  const { all, ghost } = shapes;
  const parts: HeldStageParts = {
    fov: 30,
    objects: [...all, ghost].map(({ mesh }) => mesh.object),
    isReady: () => all[0]?.isThere ?? false,
    prepare: (pane) => shapes.show(pane),
    positions: (pane) => shapes.positions(pane),
    triangles: () => shapes.triangles,
    drawn: events.drawn,
    themed: (colour) => makeGhost(ghost, colour('--modes-straight')),
  };
  const held = createHeldStage(parent, canvas, parts, events);
  const { stage } = held;
  const { redraw } = stage;
  stage.open();

  return {
    /** Another body in all panes, with a fabric's look. */
    showMesh(triangles: Uint32Array, nVertices: number, lookId: number) {
      shapes.setTopology(triangles, nVertices);
      for (const { mesh } of all) mesh.setLook(lookOf(lookId));
      held.drop();
      redraw();
    },
    setPanes(count: number, nColumns: number) {
      stage.grid.set(count, nColumns);
      stage.refit();
      redraw();
    },
    showShape(pane: number, positions: Float32Array) {
      all[pane]?.set(positions);
      redraw();
    },
    /** Null hides it. */
    showGhost(positions: Float32Array | null) {
      shapes.hasGhost = positions !== null;
      if (positions) ghost.set(positions);
      redraw();
    },
    setEdges(isShown: boolean) {
      for (const { mesh } of all) mesh.setEdges(isShown);
      redraw();
    },
    invite: held.invite,
    /**
     * Sets the view so that these places are seen, three numbers each [m]; the ghost stands behind all that the keys
     * take up.
     */
    frame(keys: readonly number[], swings: readonly number[]) {
      held.setFloor(frame(stage, ghost, keys, swings));
      redraw();
    },
    homeView: stage.control.home,
    /** Pixels from the canvas's upper left corner to a vertex. */
    project: held.project,
  };
}

export type ModesStage = ReturnType<typeof createModesStage>;
