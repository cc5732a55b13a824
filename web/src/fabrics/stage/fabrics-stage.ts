// One cloth in several panes: one renderer and one camera, a cut of the canvas for each. It gets
// frames and settings, never the solver, and draws only when something changed.
import { Box3, type Scene, Sphere, Vector3 } from 'three';
import type { Collider, Triple } from '../../shared/bindings/geometry';
import { lookOf } from '../../shared/fabric/fabric-look';
import { uprightOf } from '../../shared/stage/camera-control';
import { type ClothMesh, createClothMesh } from '../../shared/stage/cloth-mesh';
import { stepSeen } from '../../shared/stage/grab';
import {
  createHeldStage,
  type HeldStageEvents,
  type HeldStageParts,
} from '../../shared/stage/held-stage';
import type { PaneStage } from '../../shared/stage/pane-stage';
import { createHoldMarks, type HoldMark } from './hold-marks';

export interface FabricsStageEvents extends HeldStageEvents {
  drawn: HeldStageParts['drawn'];
}

/** A direction of the first view [rad]. */
export interface Direction {
  azimuth: number;
  polar: number;
}

/** Direction from above enough to see a level sheet's shape. */
const LEVEL: Direction = { azimuth: 0.5, polar: 1.08 };

/** The floor lies under the cloth by this part of its size. */
const FLOOR_BELOW = 0.25;

/** Shadows in more panes than this would take longer than the cloth. */
const MOST_SHADOWED_PANES = 4;

/** Clothes of one topology, one in each pane. */
class PaneClothes {
  private readonly clothes: ClothMesh[] = [];
  private topology: { triangles: Uint32Array; nVertices: number } = {
    triangles: new Uint32Array(0),
    nVertices: 0,
  };
  private areEdgesShown = false;

  constructor(private readonly scene: () => Scene) {}

  get count(): number {
    return this.clothes.length;
  }

  positions(pane: number): Float32Array {
    return this.clothes[pane]?.positions() ?? new Float32Array(0);
  }

  triangles(): Uint32Array {
    return this.topology.triangles;
  }

  setTopology(triangles: Uint32Array, nVertices: number): void {
    this.topology = { triangles, nVertices };
    for (const cloth of this.clothes) this.dress(cloth);
  }

  /** A cloth for each fabric. */
  setFabrics(ids: readonly number[]): void {
    for (const cloth of this.clothes.splice(ids.length)) {
      this.scene().remove(cloth.object);
      cloth.close();
    }
    while (this.clothes.length < ids.length) {
      const cloth = createClothMesh();
      this.dress(cloth);
      this.clothes.push(cloth);
      this.scene().add(cloth.object);
    }
    ids.forEach((id, pane) => {
      this.clothes[pane]?.setLook(lookOf(id));
    });
  }

  setFrame(pane: number, buffer: ArrayBuffer): void {
    this.clothes[pane]?.setFrame(buffer, 'stretch');
  }

  setEdges(isShown: boolean): void {
    this.areEdgesShown = isShown;
    for (const cloth of this.clothes) cloth.setEdges(isShown);
  }

  /** Has the cloth of one pane alone be seen. */
  show(pane: number): void {
    this.clothes.forEach((cloth, other) => {
      cloth.object.visible = other === pane && cloth.positions().length > 0;
    });
    this.clothes[pane]?.update();
  }

  /** Gives a cloth the topology and the edges of the others, and no frame yet. */
  private dress(cloth: ClothMesh): void {
    const { triangles, nVertices } = this.topology;
    cloth.setFrame(new ArrayBuffer(0), 'stretch');
    if (nVertices > 0) cloth.setTopology(triangles, nVertices);
    cloth.setEdges(this.areEdgesShown);
  }
}

/** Sets the view so that these places are seen; the height of the floor below them [m]. */
function frame(
  { surroundings, control, camera }: PaneStage,
  places: readonly number[],
  direction: Direction,
): number {
  const box = new Box3().setFromArray(places);
  const { center: centre, radius } = box.getBoundingSphere(new Sphere());
  const floor = box.min.y - FLOOR_BELOW * radius;
  surroundings.frame(centre, radius, floor);
  const view = { centre, radius, ...direction };
  control.frame({ ...view, upright: uprightOf(places, view, camera.fov) });
  return floor;
}

/** Draws into `canvas`, which fills `parent`. Throws when the browser has no WebGL 2. */
export function createFabricsStage(
  parent: HTMLElement,
  canvas: HTMLCanvasElement,
  events: FabricsStageEvents,
) {
  const marks = createHoldMarks();
  const clothes = new PaneClothes(() => held.stage.scene);
  let chosen = 0;
  const parts: HeldStageParts = {
    fov: 32,
    objects: [marks.object],
    isReady: () => clothes.count > 0,
    prepare(pane) {
      marks.face(held.stage.camera);
      clothes.show(pane);
    },
    positions: (pane) => clothes.positions(pane),
    triangles: () => clothes.triangles(),
    chosen: () => Math.min(chosen, clothes.count - 1),
    drawn(invitation) {
      if (clothes.positions(0).length > 0) events.drawn(invitation);
    },
    themed: (colour) =>
      marks.setColours({
        pin: colour('--stage-hand'),
        handle: colour('--accent'),
        chosen: colour('--alarm'),
      }),
  };
  const held = createHeldStage(parent, canvas, parts, events);
  const { stage } = held;
  const { grid, redraw } = stage;
  stage.open();

  return {
    /** Another cloth in all panes, not yet seen. */
    showMesh(triangles: Uint32Array, nVertices: number) {
      clothes.setTopology(triangles, nVertices);
      held.drop();
      redraw();
    },
    /** Fabrics by id, a pane for each; `nColumns` of them side by side. */
    setPanes(fabricIds: readonly number[], columns: number) {
      clothes.setFabrics(fabricIds);
      grid.set(clothes.count, columns);
      stage.surroundings.setShadows(clothes.count <= MOST_SHADOWED_PANES);
      stage.refit();
      redraw();
    },
    showFrame(pane: number, buffer: ArrayBuffer) {
      clothes.setFrame(pane, buffer);
      redraw();
    },
    setMarks(newMarks: readonly HoldMark[]) {
      marks.set(newMarks);
      redraw();
    },
    setBodies(bodies: Collider[]) {
      stage.surroundings.setColliders(bodies);
      redraw();
    },
    /** The pane that keys take the cloth in. */
    choose(pane: number) {
      chosen = pane;
    },
    invite: held.invite,
    setEdges(isShown: boolean) {
      clothes.setEdges(isShown);
      redraw();
    },
    /** Sets the view so that these places are seen, three numbers each [m]. */
    frame(places: readonly number[], direction = LEVEL) {
      held.setFloor(frame(stage, places, direction));
    },
    homeView: stage.control.home,
    /** A step to the right, up and away as the viewer sees it, from a place, for one key press [m]. */
    stepFrom: (place: Triple, direction: Triple) =>
      stepSeen(stage.camera, new Vector3(...place), direction).toArray(),
    positions: (pane: number) => clothes.positions(pane),
    /** Pixels from the canvas's upper left corner to a vertex. */
    project: held.project,
  };
}

export type FabricsStage = ReturnType<typeof createFabricsStage>;
