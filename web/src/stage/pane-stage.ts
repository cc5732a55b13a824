// One cloth in several panes: one renderer and one camera, a cut of the canvas for each. It gets
// frames and settings, never the solver, and draws only when something changed.
import { Box3, PerspectiveCamera, Scene, Sphere, Vector3, type WebGLRenderer } from 'three';
import type { Collider, Triple } from '../sim/wasm-module';
import { createCameraControl, uprightOf } from './camera-control';
import { createCanvas } from './canvas';
import { type ClothMesh, createClothMesh } from './cloth-mesh';
import { lookOf } from './fabric-look';
import { type Box, createHand } from './grab';
import { createHandMark } from './hand-mark';
import { createHoldMarks, type HoldMark } from './hold-marks';
import { createSurroundings } from './surroundings';

export interface PaneStageEvents {
  /** True when a press on this vertex is used up otherwise. */
  press(vertex: number, pane: number): boolean;
  grab(vertex: number, pane: number): void;
  moveGrab(target: Triple): void;
  releaseGrab(): void;
  /** Keys that are neither the camera's nor the hand's. True when used. */
  key(name: string): boolean;
  /** After each picture: where the inviting vertex is in the first pane, in pixels. */
  drawn(invitation: { x: number; y: number }): void;
  contextLost(): void;
}

export interface PaneStage {
  /** Another cloth in all panes, not yet seen. */
  showMesh(triangles: Uint32Array, nVertices: number): void;
  /** Fabrics by id, a pane for each; `nColumns` of them side by side. */
  setPanes(fabricIds: readonly number[], nColumns: number): void;
  showFrame(pane: number, buffer: ArrayBuffer): void;
  setMarks(marks: readonly HoldMark[]): void;
  setBodies(bodies: Collider[]): void;
  /** The pane that keys take the cloth in. */
  choose(pane: number): void;
  invite(vertex: number): void;
  setEdges(isShown: boolean): void;
  /** Sets the view so that these places are seen, three numbers each [m]. */
  frame(places: readonly number[]): void;
  homeView(): void;
  /** A step to the right, up and away as the viewer sees it, from a place, for one key press [m]. */
  stepFrom(place: Triple, direction: Triple): Triple;
  positions(pane: number): Float32Array;
  /** Where a vertex is seen, in pixels from the canvas's upper left corner. */
  project(vertex: number, pane: number): { x: number; y: number };
}

/** Direction of the first view [rad]: from above enough to see a level sheet's shape. */
const AZIMUTH = 0.5;
const POLAR = 1.08;

/** How far one key press moves what is held, as a part of its distance from the eye. */
const KEY_REACH = 0.02;

/** The floor lies under the cloth by this part of its size. */
const FLOOR_BELOW = 0.25;

/** With more panes than this shadows would take longer than the cloth. */
const MOST_SHADOWED_PANES = 4;

/** Draws into `canvas`, which fills `parent`. Throws when the browser has no WebGL 2. */
export function createPaneStage(
  parent: HTMLElement,
  canvas: HTMLCanvasElement,
  events: PaneStageEvents,
): PaneStage {
  const scene = new Scene();
  const camera = new PerspectiveCamera(32, 1, 0.01, 100);
  const surroundings = createSurroundings();
  const handMark = createHandMark();
  const holdMarks = createHoldMarks();
  scene.add(surroundings.object, holdMarks.object, handMark.object);

  const panes: ClothMesh[] = [];
  let topology: { triangles: Uint32Array; nVertices: number } | null = null;
  let nColumns = 1;
  let areEdgesShown = false;
  let floor = 0;
  let inviting = 0;
  let chosen = 0;
  let active = 0; // pane in which the hand is

  const { redraw, open } = createCanvas(parent, canvas, {
    draw,
    resized: refit,
    themed(colour) {
      surroundings.setTheme(colour);
      handMark.setColour(colour('--stage-hand'));
      holdMarks.setColours({
        pin: colour('--stage-hand'),
        handle: colour('--accent'),
        chosen: colour('--alarm'),
      });
    },
    key: (name) => hand.key(name) || control.key(name) || events.key(name),
    contextLost: events.contextLost,
  });
  const control = createCameraControl(canvas, camera, redraw, () => canvas.clientHeight / nRows());
  const hand = createHand(canvas, camera, {
    picture(at) {
      active = at ? paneAt(at) : Math.min(chosen, panes.length - 1);
      const pane = active;
      return () => boxOf(pane);
    },
    press: (vertex) => events.press(vertex, active),
    grab(vertex) {
      control.setResting(true);
      events.grab(vertex, active);
    },
    move: events.moveGrab,
    release() {
      control.setResting(false);
      events.releaseGrab();
    },
    fallbackVertex: () => inviting,
    cloth: () => ({
      positions: positions(active),
      triangles: topology?.triangles ?? new Uint32Array(0),
    }),
    floor: () => floor,
    onChange: redraw,
  });

  function nRows(): number {
    return Math.max(1, Math.ceil(panes.length / nColumns));
  }

  function positions(pane: number): Float32Array {
    return panes[pane]?.positions() ?? new Float32Array(0);
  }

  /** Of a pane within a rectangle. */
  function cut(pane: number, { left, top, width, height }: Box): Box {
    const [w, h] = [width / nColumns, height / nRows()];
    return {
      left: left + (pane % nColumns) * w,
      top: top + Math.floor(pane / nColumns) * h,
      width: w,
      height: h,
    };
  }

  function boxOf(pane: number): Box {
    return cut(pane, canvas.getBoundingClientRect());
  }

  function paneAt({ x, y }: { x: number; y: number }): number {
    const found = panes.findIndex((_, pane) => {
      const box = boxOf(pane);
      const isInside = (at: number, low: number, size: number) => at >= low && at < low + size;
      return isInside(x, box.left, box.width) && isInside(y, box.top, box.height);
    });
    return Math.max(0, found);
  }

  function refit(): void {
    const { clientWidth: width, clientHeight: height } = parent;
    if (width === 0 || height === 0) return;
    camera.aspect = width / nColumns / (height / nRows());
    control.refit();
  }

  function project(vertex: number, pane: number): { x: number; y: number } {
    const place = new Vector3().fromArray(positions(pane), 3 * vertex).project(camera);
    const { clientWidth: width, clientHeight: height } = canvas;
    const box = cut(pane, { left: 0, top: 0, width, height });
    return {
      x: box.left + ((place.x + 1) / 2) * box.width,
      y: box.top + ((1 - place.y) / 2) * box.height,
    };
  }

  function draw(renderer: WebGLRenderer): void {
    const { clientWidth: width, clientHeight: height } = canvas;
    if (width === 0 || panes.length === 0) return;
    holdMarks.face(camera);
    renderer.setScissorTest(true);
    const held = hand.vertex();
    panes.forEach((pane, index) => {
      for (const other of panes) other.object.visible = other === pane;
      const isSeen = pane.positions().length > 0;
      pane.object.visible = isSeen;
      if (isSeen) pane.update();
      const place =
        held !== null && index === active
          ? new Vector3().fromArray(pane.positions(), 3 * held)
          : null;
      handMark.place(place, hand.target(), camera);
      const box = cut(index, { left: 0, top: 0, width, height });
      const bottom = height - box.top - box.height;
      renderer.setViewport(box.left, bottom, box.width, box.height);
      renderer.setScissor(box.left, bottom, box.width, box.height);
      renderer.render(scene, camera);
    });
    if (positions(0).length > 0) events.drawn(project(inviting, 0));
  }

  /** Without a frame yet. */
  function dress(cloth: ClothMesh): void {
    cloth.setFrame(new ArrayBuffer(0), 'stretch');
    if (topology) cloth.setTopology(topology.triangles, topology.nVertices);
    cloth.setEdges(areEdgesShown);
  }

  open();

  return {
    showMesh(triangles, nVertices) {
      topology = { triangles, nVertices };
      for (const pane of panes) dress(pane);
      hand.drop();
      control.setResting(false);
      redraw();
    },
    setPanes(fabricIds, columns) {
      for (const pane of panes.splice(fabricIds.length)) {
        scene.remove(pane.object);
        pane.close();
      }
      while (panes.length < fabricIds.length) {
        const pane = createClothMesh();
        dress(pane);
        panes.push(pane);
        scene.add(pane.object);
      }
      fabricIds.forEach((id, pane) => {
        panes[pane]?.setLook(lookOf(id));
      });
      nColumns = columns;
      surroundings.setShadows(panes.length <= MOST_SHADOWED_PANES);
      refit();
      redraw();
    },
    showFrame(pane, buffer) {
      panes[pane]?.setFrame(buffer, 'stretch');
      redraw();
    },
    setMarks(marks) {
      holdMarks.set(marks);
      redraw();
    },
    setBodies(bodies) {
      surroundings.setColliders(bodies);
      redraw();
    },
    choose(pane) {
      chosen = pane;
    },
    invite(vertex) {
      inviting = vertex;
      redraw();
    },
    setEdges(isShown) {
      areEdgesShown = isShown;
      for (const pane of panes) pane.setEdges(isShown);
      redraw();
    },
    frame(places) {
      const box = new Box3().setFromArray(places);
      const { center: centre, radius } = box.getBoundingSphere(new Sphere());
      floor = box.min.y - FLOOR_BELOW * radius;
      surroundings.frame(centre, radius, floor);
      const view = { centre, radius, azimuth: AZIMUTH, polar: POLAR };
      control.frame({ ...view, upright: uprightOf(places, view, camera.fov) });
    },
    homeView: control.home,
    stepFrom(place, [right, up, away]) {
      const from = new Vector3(...place);
      const reach = KEY_REACH * camera.position.distanceTo(from);
      const axis = (index: number) => new Vector3().setFromMatrixColumn(camera.matrixWorld, index);
      return from
        .addScaledVector(axis(0), right * reach)
        .addScaledVector(axis(1), up * reach)
        .addScaledVector(axis(2), -away * reach)
        .toArray();
    },
    positions,
    project,
  };
}
