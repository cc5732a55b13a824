// One garment in three panes, each on a mesh of its own, on the same figure: one renderer, one camera
// that goes along. It gets frames and settings, never the workers, and draws only when something changed.
import { PerspectiveCamera, Scene, Vector3, type WebGLRenderer } from 'three';
import { lookOf } from '../../shared/fabric/fabric-look';
import { createCameraControl } from '../../shared/stage/camera-control';
import { createCanvas } from '../../shared/stage/canvas';
import { createPaneGrid } from '../../shared/stage/pane-grid';
import { pick } from '../../shared/stage/pick';
import { createSurroundings } from '../../shared/stage/surroundings';
import type { SolidsAnswer } from '../bindings/refinement-module';
import type { GarmentMesh } from '../worker/garment-protocol';
import { createGradedCloth, type GradedCloth, type Paint } from './graded-cloth';
import { createMannequin } from './mannequin';

export interface GarmentStageEvents {
  /** A press that was no drag: the face of that pane, or null beside the cloth. */
  press(pane: number, face: number | null): void;
  /** Keys that are not the camera's. True when used. */
  key(name: string): boolean;
  contextLost(): void;
}

export interface GarmentStage {
  setMesh(pane: number, mesh: GarmentMesh): void;
  showFrame(pane: number, buffer: ArrayBuffer): void;
  setSolids(solids: SolidsAnswer): void;
  /** A cloth that does not move with its figure is left out. */
  setShown(pane: number, isShown: boolean): void;
  setPaint(pane: number, paint: Paint): void;
  setEdges(isShown: boolean): void;
  setHanging(isShown: boolean): void;
  setFabric(fabricId: number): void;
  setChosen(pane: number, face: number | null): void;
  homeView(): void;
  redraw(): void;
  positions(pane: number): Float32Array;
  triangles(pane: number): Uint32Array;
  scalars(pane: number): Float32Array;
  /** Where a vertex is seen, in pixels from the canvas's upper left corner. */
  project(vertex: number, pane: number): { x: number; y: number };
  /** The picture as it is, as a PNG. */
  picture(): Promise<Blob | null>;
}

const N_PANES = 3;

/** From the front and a little from the side that is nearer to the viewer [rad]. */
const AZIMUTH = 1.02;
const POLAR = 1.36;

/** What has to be seen of a walking person [m]: the middle above the floor, half of the width, height. */
const MIDDLE_M = 0.78;
const SEEN_ACROSS_M = 0.5;
const SEEN_UP_M = 0.86;

/** Of the light and the shadows around the person [m]. */
const LIT_RADIUS_M = 0.8;

/** A press that moved farther is a drag [CSS pixels], or lasted longer [ms]. */
const PRESS_REACH = 5;
const PRESS_MS = 500;

/** Draws into `canvas`, which fills `parent`. Throws when the browser has no WebGL 2. */
export function createGarmentStage(
  parent: HTMLElement,
  canvas: HTMLCanvasElement,
  events: GarmentStageEvents,
): GarmentStage {
  const scene = new Scene();
  const camera = new PerspectiveCamera(30, 1, 0.01, 100);
  const surroundings = createSurroundings();
  const mannequin = createMannequin();
  const panes: GradedCloth[] = Array.from({ length: N_PANES }, createGradedCloth);
  scene.add(surroundings.object, mannequin.object, ...panes.map(({ object }) => object));
  const leftOut: boolean[] = [];
  const grid = createPaneGrid(canvas, camera);
  grid.set(N_PANES, N_PANES); // side by side, as people do: they are higher than wide
  let isFramed = false;
  let colours = { line: '#000000', dot: '#000000' };
  let areEdgesShown = false;
  let areHangingShown = false;
  let onPicture: ((picture: Blob | null) => void) | null = null;

  const { redraw, open } = createCanvas(parent, canvas, {
    draw,
    resized() {
      grid.fit();
      control.refit();
    },
    themed(colour) {
      surroundings.setTheme(colour);
      mannequin.setColour(colour('--stage-body'));
      colours = { line: colour('--mesh-line'), dot: colour('--mesh-dot') };
      showLines();
    },
    key: (name) => control.key(name) || events.key(name),
    contextLost: events.contextLost,
  });
  const control = createCameraControl(canvas, camera, redraw);

  function showLines(): void {
    for (const pane of panes) {
      pane.setEdges(areEdgesShown, colours.line);
      pane.setHanging(areHangingShown, colours.dot);
    }
    redraw();
  }

  function positions(pane: number): Float32Array {
    return panes[pane]?.positions() ?? new Float32Array(0);
  }

  function draw(renderer: WebGLRenderer): void {
    if (canvas.clientWidth === 0 || !isFramed) return;
    grid.draw(renderer, (index) => {
      panes.forEach((other, k) => {
        other.object.visible = k === index && !leftOut[k] && other.positions().length > 0;
      });
      panes[index]?.update();
      renderer.render(scene, camera);
    });
    if (!onPicture) return;
    canvas.toBlob(onPicture);
    onPicture = null;
  }

  function follow(pelvis: Vector3): void {
    // The height stays: who squats goes down in the picture.
    const centre = new Vector3(pelvis.x, MIDDLE_M, pelvis.z);
    if (!isFramed) {
      surroundings.frame(centre, LIT_RADIUS_M, 0);
      const view = { centre, radius: SEEN_ACROSS_M, azimuth: AZIMUTH, polar: POLAR };
      control.frame({ ...view, upright: SEEN_UP_M / SEEN_ACROSS_M });
    }
    isFramed = true;
    control.follow(centre);
    surroundings.follow(centre.x, centre.z);
  }

  function faceAt(pane: number, x: number, y: number): number | null {
    const box = grid.boxOf(pane);
    const across = (2 * (x - box.left)) / box.width - 1;
    const up = 1 - (2 * (y - box.top)) / box.height;
    const ahead = new Vector3(across, up, 0.5).unproject(camera).sub(camera.position).normalize();
    const cloth = panes[pane];
    if (!cloth) return null;
    const hit = pick(
      cloth.positions(),
      cloth.triangles(),
      camera.position.toArray(),
      ahead.toArray(),
    );
    return hit ? cloth.faceOf(hit.triangle) : null;
  }

  let pressed: { x: number; y: number; timeMs: number } | null = null;
  canvas.addEventListener('pointerdown', ({ clientX: x, clientY: y, timeStamp, isPrimary }) => {
    pressed = isPrimary ? { x, y, timeMs: timeStamp } : null;
  });
  canvas.addEventListener('pointerup', ({ clientX: x, clientY: y, timeStamp }) => {
    const start = pressed;
    pressed = null;
    if (!start || timeStamp - start.timeMs > PRESS_MS) return;
    if (Math.hypot(x - start.x, y - start.y) > PRESS_REACH) return;
    const pane = grid.paneAt({ x, y });
    events.press(pane, faceAt(pane, x, y));
  });

  open();

  return {
    setMesh(pane, mesh) {
      panes[pane]?.setMesh(mesh);
      redraw();
    },
    showFrame(pane, buffer) {
      panes[pane]?.setFrame(buffer);
      redraw();
    },
    setSolids({ cones, pelvis_m: pelvis }) {
      mannequin.setCones(cones);
      if (pelvis) follow(new Vector3(...pelvis));
      redraw();
    },
    setShown(pane, isShown) {
      leftOut[pane] = !isShown;
      redraw();
    },
    setPaint(pane, paint) {
      panes[pane]?.setPaint(paint);
      redraw();
    },
    setEdges(isShown) {
      areEdgesShown = isShown;
      showLines();
    },
    setHanging(isShown) {
      areHangingShown = isShown;
      showLines();
    },
    setFabric(fabricId) {
      for (const pane of panes) pane.setLook(lookOf(fabricId));
      redraw();
    },
    setChosen(pane, face) {
      panes[pane]?.setChosen(face);
      redraw();
    },
    homeView: control.home,
    redraw,
    positions,
    triangles: (pane) => panes[pane]?.triangles() ?? new Uint32Array(0),
    scalars: (pane) => panes[pane]?.scalars() ?? new Float32Array(0),
    project: (vertex, pane) => grid.project(positions(pane), vertex, pane),
    picture() {
      return new Promise((resolve) => {
        onPicture = resolve;
        redraw();
      });
    },
  };
}
