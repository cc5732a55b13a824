// The picture: renderer, camera, light, cloth, hand. It gets frames and settings, never the
// simulation, and draws only when something changed.
import { Vector3 } from 'three';
import type { Scalar } from '../../shared/bindings/frame';
import type { Collider } from '../../shared/bindings/geometry';
import { lookOf } from '../../shared/fabric/fabric-look';
import type { Pose } from '../../shared/stage/camera-control';
import { type ClothMesh, createClothMesh } from '../../shared/stage/cloth-mesh';
import type { Print } from '../../shared/stage/fabric-material';
import { floorHeight, frame, framedSphere } from '../../shared/stage/framing';
import type { HeatMap, HeatScale } from '../../shared/stage/heat-map';
import {
  createHeldStage,
  type HeldStageEvents,
  type HeldStageParts,
} from '../../shared/stage/held-stage';
import { createOverlays, type Overlay } from '../../shared/stage/overlay';
import { invitingVertex } from './inviting';

export interface MotionStageEvents extends HeldStageEvents {
  /** Hears of each drawn frame. */
  drawn(picture: DrawnPicture): void;
}

export interface DrawnPicture {
  heatScale: HeatScale;
  /** Pixels at which the invitation belongs. */
  invitation: { x: number; y: number };
  /** Pose from which it is seen; null for that of the scene's first view. */
  camera: Pose | null;
}

/** Settings of how the cloth is drawn. */
function drawingOf(cloth: ClothMesh, redraw: () => void) {
  return {
    setFabric(id: number) {
      cloth.setLook(lookOf(id));
      redraw();
    },
    /** Paints the cloth, once its mesh has as many vertices. */
    setPrint(print: Print | null) {
      cloth.setPrint(print);
      redraw();
    },
    setHeat(map: HeatMap, range: 'auto' | number) {
      if (cloth.setHeat(map, range)) redraw();
    },
    setEdges(isShown: boolean) {
      cloth.setEdges(isShown);
      redraw();
    },
  };
}

/** Draws into `canvas`, which fills `parent`. Throws when the browser has no WebGL 2. */
export function createMotionStage(
  parent: HTMLElement,
  canvas: HTMLCanvasElement,
  events: MotionStageEvents,
) {
  const cloth = createClothMesh();
  const overlays = createOverlays();
  let awaitsFraming = false;
  let isFreshMesh = false;
  let wantedPose: Pose | null = null;

  const parts: HeldStageParts = {
    fov: 32,
    objects: [cloth.object],
    isReady: () => cloth.positions().length > 0,
    prepare() {
      cloth.update();
      overlays.update(cloth.positions(), stage.camera.position);
    },
    positions: () => cloth.positions(),
    triangles: () => cloth.triangles(),
    drawn: (invitation) =>
      events.drawn({ heatScale: cloth.heatScale(), invitation, camera: stage.control.pose() }),
    themed: (colour) => overlays.themed(colour),
  };
  const held = createHeldStage(parent, canvas, parts, events);
  const { stage } = held;
  const { redraw } = stage;

  function chooseInviting(): void {
    const towards = stage.camera.getWorldDirection(new Vector3()).negate();
    held.invite(invitingVertex(cloth.positions(), cloth.triangles(), towards));
  }

  stage.open();

  return {
    /** A new mesh; the view is set anew when it belongs to a new scene, and a hand keeps hold of what tears. */
    showMesh(triangles: Uint32Array, nVertices: number, change: 'scene' | 'mesh' | 'tear') {
      cloth.setTopology(triangles, nVertices);
      overlays.clear();
      if (change === 'tear') return;
      awaitsFraming = change === 'scene';
      isFreshMesh = true;
      held.drop();
    },
    showFrame(buffer: ArrayBuffer, scalar: Scalar) {
      cloth.setFrame(buffer, scalar);
      if (isFreshMesh) chooseInviting();
      isFreshMesh = false;
      redraw();
    },
    setColliders(colliders: Collider[]) {
      stage.surroundings.setColliders(colliders);
      if (awaitsFraming) {
        awaitsFraming = false;
        const sphere = framedSphere(cloth.positions(), colliders);
        const floor = floorHeight(sphere, colliders);
        held.setFloor(floor);
        frame(stage, sphere, floor);
        stage.control.setPose(wantedPose);
        chooseInviting();
      }
      redraw();
    },
    ...drawingOf(cloth, redraw),
    /** Draws it too, from now on. */
    addOverlay: (overlay: Overlay) => overlays.add(overlay, stage.scene),
    /** Draws anew, as an overlay has changed. */
    redraw,
    homeView: stage.control.home,
    /** Sets from where the scene is seen, also once it is another one. */
    setCamera(pose: Pose | null) {
      wantedPose = pose;
      if (JSON.stringify(pose) !== JSON.stringify(stage.control.pose()))
        stage.control.setPose(pose);
    },
    /** Present positions, three numbers a vertex [m]. */
    positions: () => cloth.positions(),
    /** Pixels from the canvas's upper left corner to a vertex. */
    project: (vertex: number) => held.project(vertex, 0),
    /** The vertex that asks to be taken. */
    inviting: held.inviting,
  };
}

export type MotionStage = ReturnType<typeof createMotionStage>;
