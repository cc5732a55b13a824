// The picture of both sides, in two panes under one camera.
import { Box3, Vector3 } from 'three';
import type { Collider } from '../../shared/bindings/geometry';
import { lookOf } from '../../shared/fabric/fabric-look';
import { type ClothMesh, createClothMesh } from '../../shared/stage/cloth-mesh';
import { floorHeight, frame, framedSphere } from '../../shared/stage/framing';
import { createPaneStage } from '../../shared/stage/pane-stage';
import { createSpringLines, type SpringLines } from '../../shared/stage/spring-lines';

export interface DuelStageEvents {
  key(name: string): boolean;
  pictureLost(isLost: boolean): void;
}

export interface DuelMesh {
  triangles: Uint32Array;
  /** Two vertices a spring: lines that are drawn. */
  springEnds: Uint32Array;
  nVertices: number;
}

const N_PANES = 2;

/** Draws into `canvas`, which fills `parent`. Throws when the browser has no WebGL 2. */
export function createDuelStage(
  parent: HTMLElement,
  canvas: HTMLCanvasElement,
  events: DuelStageEvents,
) {
  const clothes: readonly [ClothMesh, ClothMesh] = [createClothMesh(), createClothMesh()];
  const clothOf = (pane: number) => clothes[pane === 0 ? 0 : 1];
  const springs: readonly [SpringLines, SpringLines] = [createSpringLines(), createSpringLines()];
  const hasSprings = [false, false];
  const springsOf = (pane: number) => springs[pane === 0 ? 0 : 1];
  for (const cloth of clothes) cloth.setEdges(true);
  const stage = createPaneStage(parent, canvas, {
    fov: 32,
    objects: [...clothes, ...springs].map(({ object }) => object),
    isReady: () => clothOf(0).positions().length > 0,
    prepare(shown) {
      clothes.forEach((cloth, pane) => {
        cloth.object.visible = pane === shown;
        springsOf(pane).object.visible = pane === shown && hasSprings[pane] === true;
      });
      clothOf(shown).update();
      springsOf(shown).update(clothOf(shown).positions());
    },
    drawn() {},
    themed(colour) {
      const line = colour('--spring-implicit');
      for (const one of springs) one.setColours({ explicit: line, implicit: line });
    },
    key: events.key,
    pictureLost: events.pictureLost,
  });
  const { grid, redraw } = stage;
  grid.set(N_PANES, N_PANES);
  stage.open();

  return {
    showMesh(pane: number, { triangles, springEnds, nVertices }: DuelMesh) {
      clothOf(pane).setTopology(triangles, nVertices);
      hasSprings[pane] = springEnds.length > 0;
      springsOf(pane).setSplit({
        ends: springEnds,
        isImplicit: new Int8Array(springEnds.length / 2),
      });
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
    homeView: stage.control.home,
    positions: (pane: number) => clothOf(pane).positions(),
  };
}

export type DuelStage = ReturnType<typeof createDuelStage>;
