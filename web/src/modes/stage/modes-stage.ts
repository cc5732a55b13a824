// One body that swings, in one energy or in two side by side, and the ghost of the straight way. It gets
// shapes, never the solver, and draws only when something changed.
import { Box3, Sphere } from 'three';
import { FLOATS_PER_VERTEX, frameViews } from '../../shared/bindings/frame';
import { lookOf } from '../../shared/fabric/fabric-look';
import { uprightOf } from '../../shared/stage/camera-control';
import { type ClothMesh, createClothMesh } from '../../shared/stage/cloth-mesh';
import { createPaneStage } from '../../shared/stage/pane-stage';

export interface ModesStageEvents {
  /** Keys that are not the camera's. True when used. */
  key(name: string): boolean;
  pictureLost(isLost: boolean): void;
}

export interface ModesStage {
  /** Another body in all panes, with a fabric's look. */
  showMesh(triangles: Uint32Array, nVertices: number, lookId: number): void;
  setPanes(count: number, nColumns: number): void;
  showShape(pane: number, positions: Float32Array): void;
  /** Null hides it. */
  showGhost(positions: Float32Array | null): void;
  setEdges(isShown: boolean): void;
  /** Sets the view so that these places are seen, three numbers each [m]. */
  frame(places: readonly number[]): void;
  homeView(): void;
}

/** Direction of the first view [rad]. */
const AZIMUTH = 0.42;
const POLAR = 1.2;

/** The floor lies under the body by this part of its size. */
const FLOOR_BELOW = 0.2;

const GHOST_OPACITY = 0.42;

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

/** What is seen through: it throws no shadow, and hides nothing behind it. */
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

/** Draws into `canvas`, which fills `parent`. Throws when the browser has no WebGL 2. */
export function createModesStage(
  parent: HTMLElement,
  canvas: HTMLCanvasElement,
  events: ModesStageEvents,
): ModesStage {
  const shapes = Array.from({ length: MOST_PANES }, () => new Shape());
  const ghost = new Shape();
  let hasGhost = false;
  const stage = createPaneStage(parent, canvas, {
    fov: 30,
    objects: [...shapes, ghost].map(({ mesh }) => mesh.object),
    isReady: () => shapes[0]?.isThere ?? false,
    prepare(pane) {
      shapes.forEach((shape, other) => {
        shape.mesh.object.visible = other === pane && shape.isThere;
      });
      ghost.mesh.object.visible = hasGhost && pane === 0;
      for (const { mesh } of [...shapes, ghost]) if (mesh.object.visible) mesh.update();
    },
    drawn: () => undefined,
    themed: (colour) => makeGhost(ghost, colour('--modes-ghost')),
    key: events.key,
    pictureLost: events.pictureLost,
  });
  const { redraw, grid, surroundings, control, camera } = stage;
  stage.open();
  return {
    showMesh(triangles, nVertices, lookId) {
      for (const shape of [...shapes, ghost]) shape.setTopology(triangles, nVertices);
      for (const { mesh } of shapes) mesh.setLook(lookOf(lookId));
      hasGhost = false;
      redraw();
    },
    setPanes(count, nColumns) {
      grid.set(count, nColumns);
      stage.refit();
      redraw();
    },
    showShape(pane, positions) {
      shapes[pane]?.set(positions);
      redraw();
    },
    showGhost(positions) {
      hasGhost = positions !== null;
      if (positions) ghost.set(positions);
      redraw();
    },
    setEdges(isShown) {
      for (const { mesh } of shapes) mesh.setEdges(isShown);
      redraw();
    },
    frame(places) {
      const box = new Box3().setFromArray(places);
      const { center: centre, radius } = box.getBoundingSphere(new Sphere());
      surroundings.frame(centre, radius, box.min.y - FLOOR_BELOW * radius);
      const view = { centre, radius, azimuth: AZIMUTH, polar: POLAR };
      control.frame({ ...view, upright: uprightOf(places, view, camera.fov) });
      redraw();
    },
    homeView: control.home,
  };
}
