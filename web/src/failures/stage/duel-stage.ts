// The picture of both sides, in two panes under one camera, with a hand that takes the cloth in either.
import { Box3, Vector3 } from 'three';
import type { Collider } from '../../shared/bindings/geometry';
import { lookOf } from '../../shared/fabric/fabric-look';
import { type ClothMesh, createClothMesh } from '../../shared/stage/cloth-mesh';
import { floorHeight, frame, framedSphere } from '../../shared/stage/framing';
import { createHeldStage, type HeldStageEvents } from '../../shared/stage/held-stage';

export interface DuelMesh {
  triangles: Uint32Array;
  nVertices: number;
}

const N_PANES = 2;

/** Draws into `canvas`, which fills `parent`. Throws when the browser has no WebGL 2. */
export function createDuelStage(
  parent: HTMLElement,
  canvas: HTMLCanvasElement,
  events: HeldStageEvents,
) {
  const clothes: readonly [ClothMesh, ClothMesh] = [createClothMesh(), createClothMesh()];
  const clothOf = (pane: number) => clothes[pane === 0 ? 0 : 1];
  const parts = {
    fov: 32,
    objects: clothes.map(({ object }) => object),
    isReady: () => clothOf(0).positions().length > 0,
    prepare(shown: number) {
      clothes.forEach((cloth, pane) => {
        cloth.object.visible = pane === shown;
      });
      clothOf(shown).update();
    },
    positions: (pane: number) => clothOf(pane).positions(),
    triangles: () => clothOf(0).triangles(),
    drawn() {},
    themed() {},
  };
  const held = createHeldStage(parent, canvas, parts, events);
  const { stage } = held;
  const { grid, redraw } = stage;
  grid.set(N_PANES, N_PANES);
  stage.open();

  return {
    showMesh(pane: number, { triangles, nVertices }: DuelMesh) {
      clothOf(pane).setTopology(triangles, nVertices);
      held.drop();
      held.invite(Math.floor(nVertices / 2)); // keys take it by its middle
    },
    showFrame(pane: number, buffer: ArrayBuffer) {
      clothOf(pane).setFrame(buffer, 'stretch');
      redraw();
    },
    setColliders: stage.surroundings.setColliders,
    /** Shows all of what stands in the first pane. */
    frame(colliders: Collider[]) {
      const sphere = framedSphere(clothOf(0).positions(), colliders);
      const floor = floorHeight(sphere, colliders);
      held.setFloor(floor);
      frame(stage, sphere, floor);
      redraw();
    },
    /** Keeps the middle of what stands in a pane in the middle of the picture. */
    follow(pane: number) {
      const box = new Box3().setFromArray(clothOf(pane).positions());
      stage.control.follow(box.getCenter(new Vector3()));
      redraw();
    },
    /** Panes side by side, or one above the other. */
    setColumns(nColumns: number) {
      grid.set(N_PANES, nColumns);
      stage.refit();
      redraw();
    },
    setFabric(id: number) {
      for (const cloth of clothes) cloth.setLook(lookOf(id));
      redraw();
    },
    setEdges(areShown: boolean) {
      for (const cloth of clothes) cloth.setEdges(areShown);
      redraw();
    },
    homeView: stage.control.home,
    /** Pixels from the canvas's upper left corner to a vertex. */
    project: (vertex: number, pane = 0) => held.project(vertex, pane),
  };
}

export type DuelStage = ReturnType<typeof createDuelStage>;
