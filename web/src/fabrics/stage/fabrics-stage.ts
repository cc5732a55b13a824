// One cloth in several panes: one renderer and one camera, a cut of the canvas for each. It gets
// frames and settings, never the solver, and draws only when something changed.
import { Box3, PerspectiveCamera, Scene, Sphere, Vector3, type WebGLRenderer } from 'three';
import type { Collider, Triple } from '../../shared/bindings/geometry';
import { lookOf } from '../../shared/fabric/fabric-look';
import { createCameraControl, uprightOf } from '../../shared/stage/camera-control';
import { createCanvas } from '../../shared/stage/canvas';
import { type ClothMesh, createClothMesh } from '../../shared/stage/cloth-mesh';
import { createHand } from '../../shared/stage/grab';
import { createHandMark } from '../../shared/stage/hand-mark';
import { createPaneGrid } from '../../shared/stage/pane-grid';
import { createSurroundings } from '../../shared/stage/surroundings';
import { createHoldMarks, type HoldMark } from './hold-marks';

export interface FabricsStageEvents {
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

export interface FabricsStage {
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
export function createFabricsStage(
  parent: HTMLElement,
  canvas: HTMLCanvasElement,
  events: FabricsStageEvents,
): FabricsStage {
  const scene = new Scene();
  const camera = new PerspectiveCamera(32, 1, 0.01, 100);
  const surroundings = createSurroundings();
  const handMark = createHandMark();
  const holdMarks = createHoldMarks();
  scene.add(surroundings.object, holdMarks.object, handMark.object);

  const panes: ClothMesh[] = [];
  const grid = createPaneGrid(canvas, camera);
  let topology: { triangles: Uint32Array; nVertices: number } | null = null;
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
  const control = createCameraControl(canvas, camera, redraw, grid.paneHeight);
  const hand = createHand(canvas, camera, {
    picture(at) {
      active = at ? grid.paneAt(at) : Math.min(chosen, panes.length - 1);
      const pane = active;
      return () => grid.boxOf(pane);
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

  function positions(pane: number): Float32Array {
    return panes[pane]?.positions() ?? new Float32Array(0);
  }

  function refit(): void {
    grid.fit();
    control.refit();
  }

  function project(vertex: number, pane: number): { x: number; y: number } {
    return grid.project(positions(pane), vertex, pane);
  }

  function draw(renderer: WebGLRenderer): void {
    if (canvas.clientWidth === 0 || panes.length === 0) return;
    holdMarks.face(camera);
    const held = hand.vertex();
    grid.draw(renderer, (index) => {
      panes.forEach((other, k) => {
        other.object.visible = k === index && other.positions().length > 0;
      });
      panes[index]?.update();
      const place =
        held !== null && index === active
          ? new Vector3().fromArray(positions(index), 3 * held)
          : null;
      handMark.place(place, hand.target(), camera);
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
      grid.set(panes.length, columns);
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
