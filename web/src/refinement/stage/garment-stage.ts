// One garment in up to three panes, each on a mesh of its own, on the same body: one renderer, one camera
// that goes along. It gets frames and settings, never the workers, and draws only when something changed.
import { type PerspectiveCamera, Vector3 } from 'three';
import { lookOf } from '../../shared/fabric/fabric-look';
import type { Box } from '../../shared/stage/grab';
import { createPaneStage, type PaneStage } from '../../shared/stage/pane-stage';
import { pick } from '../../shared/stage/pick';
import type { SolidsAnswer } from '../bindings/refinement-module';
import type { GarmentMesh } from '../worker/garment-protocol';
import { createBody } from './body';
import { createGradedCloth, type GradedCloth, type Paint } from './graded-cloth';

export interface GarmentStageEvents {
  /** A press that was no drag: the face of that pane, or null beside the cloth. */
  press(pane: number, face: number | null): void;
  /** Keys that are not the camera's. True when used. */
  key(name: string): boolean;
  pictureLost(isLost: boolean): void;
}

const N_PANES = 4; // three are seen at a time

/** Direction of the first view: the front, and a little of the nearer side [rad]. */
const AZIMUTH = 1.02;
const POLAR = 1.36;

/** The view of a walking person [m]: the middle above the floor, half of the width, height. */
const MIDDLE_M = 0.78;
const SEEN_ACROSS_M = 0.5;
const SEEN_UP_M = 0.86;

/** Share of a person's picture that is seen around a hem, and its middle above the edge [m]. */
const HEM_ZOOM = 0.42;
const ABOVE_HEM_M = 0.09;
const HEM_POLAR = 1.45;

/** Radius of the light and the shadows around the person [m]. */
const LIT_RADIUS_M = 0.8;

/** A press that moved farther is a drag [CSS pixels], or lasted longer [ms]. */
const PRESS_REACH = 5;
const PRESS_MS = 500;

/** Hears a press that was no drag, by where it was on the page. */
function listenToPresses(canvas: HTMLCanvasElement, onPress: (x: number, y: number) => void): void {
  let pressed: { x: number; y: number; timeMs: number } | null = null;
  canvas.addEventListener('pointerdown', ({ clientX: x, clientY: y, timeStamp, isPrimary }) => {
    pressed = isPrimary ? { x, y, timeMs: timeStamp } : null;
  });
  canvas.addEventListener('pointerup', ({ clientX: x, clientY: y, timeStamp }) => {
    const start = pressed;
    pressed = null;
    if (!start || timeStamp - start.timeMs > PRESS_MS) return;
    if (Math.hypot(x - start.x, y - start.y) <= PRESS_REACH) onPress(x, y);
  });
}

/** The face of a cloth that is seen at a point of the page; null beside the cloth. */
function faceAt(
  cloth: GradedCloth,
  camera: PerspectiveCamera,
  box: Box,
  x: number,
  y: number,
): number | null {
  const across = (2 * (x - box.left)) / box.width - 1;
  const up = 1 - (2 * (y - box.top)) / box.height;
  const ahead = new Vector3(across, up, 0.5).unproject(camera).sub(camera.position).normalize();
  const eye = camera.position.toArray();
  const hit = pick(cloth.positions(), cloth.triangles(), eye, ahead.toArray());
  return hit ? cloth.faceOf(hit.triangle) : null;
}

/** The first view of a person who stands there. */
function frame({ surroundings, control }: PaneStage, centre: Vector3): void {
  surroundings.frame(centre, LIT_RADIUS_M, 0);
  const view = { centre, radius: SEEN_ACROSS_M, azimuth: AZIMUTH, polar: POLAR };
  control.frame({ ...view, upright: SEEN_UP_M / SEEN_ACROSS_M });
}

/** The clothes on their body, and what is drawn of them. */
export class GarmentStage {
  private readonly clothes: GradedCloth[] = Array.from({ length: N_PANES }, createGradedCloth);
  private readonly body = createBody();
  private readonly stage: PaneStage;
  private areEdgesShown = false;
  private areHangingShown = false;
  private onPicture: ((picture: Blob | null) => void) | null = null;
  private shown: readonly number[] = [];
  private isFramed = false;
  private colours = { line: '#000000', dot: '#000000' };

  /** Draws into `canvas`, which fills `parent`. Throws when the browser has no WebGL 2. */
  constructor(
    parent: HTMLElement,
    private readonly canvas: HTMLCanvasElement,
    events: GarmentStageEvents,
  ) {
    this.stage = createPaneStage(parent, canvas, {
      fov: 30,
      objects: [this.body.object, ...this.clothes.map(({ object }) => object)],
      isReady: () => this.isFramed,
      prepare: (place) => this.prepare(this.paneIn(place)),
      drawn: () => this.drawn(),
      themed: (colour) => this.setTheme(colour),
      key: events.key,
      pictureLost: events.pictureLost,
    });
    const { grid, camera } = this.stage;
    this.setPanes(this.clothes.map((_, pane) => pane));
    listenToPresses(canvas, (x, y) => {
      const place = grid.paneAt({ x, y });
      const pane = this.paneIn(place);
      const cloth = this.clothes[pane];
      events.press(pane, cloth ? faceAt(cloth, camera, grid.boxOf(place), x, y) : null);
    });
    this.stage.open();
  }

  setMesh(pane: number, mesh: GarmentMesh): void {
    this.clothes[pane]?.setMesh(mesh);
    this.stage.redraw();
  }

  showFrame(pane: number, buffer: ArrayBuffer): void {
    this.clothes[pane]?.setFrame(buffer);
    this.stage.redraw();
  }

  setSolids({ cones, pelvis_m: pelvis }: SolidsAnswer): void {
    this.body.setCones(cones);
    if (pelvis) this.follow(new Vector3(...pelvis));
    this.stage.redraw();
  }

  /** The panes that have a place, from left to right: side by side, as people are higher than wide. */
  setPanes(panes: readonly number[]): void {
    this.shown = panes;
    this.stage.grid.set(panes.length, panes.length);
    this.stage.refit();
    this.stage.redraw();
  }

  setPaint(pane: number, paint: Paint): void {
    this.clothes[pane]?.setPaint(paint);
    this.stage.redraw();
  }

  setEdges(isShown: boolean): void {
    this.areEdgesShown = isShown;
    this.showLines();
  }

  setHanging(isShown: boolean): void {
    this.areHangingShown = isShown;
    this.showLines();
  }

  setFabric(fabricId: number): void {
    for (const cloth of this.clothes) cloth.setLook(lookOf(fabricId));
    this.stage.redraw();
  }

  setChosen(pane: number, face: number | null): void {
    this.clothes[pane]?.setChosen(face);
    this.stage.redraw();
  }

  homeView(): void {
    this.stage.control.home();
  }

  /** Close to the lower edge of a pane's cloth, as it is now. */
  hemView(pane: number): void {
    const places = this.positions(pane);
    let low = Number.POSITIVE_INFINITY;
    for (let k = 1; k < places.length; k += 3) low = Math.min(low, places[k] as number);
    if (!Number.isFinite(low)) return;
    const shift = (low + ABOVE_HEM_M - MIDDLE_M) / SEEN_ACROSS_M;
    this.stage.control.setPose({
      azimuth: AZIMUTH,
      polar: HEM_POLAR,
      zoom: HEM_ZOOM,
      shift: [0, shift, 0],
    });
    this.stage.redraw();
  }

  positions(pane: number): Float32Array {
    return this.clothes[pane]?.positions() ?? new Float32Array(0);
  }

  triangles(pane: number): Uint32Array {
    return this.clothes[pane]?.triangles() ?? new Uint32Array(0);
  }

  scalars(pane: number): Float32Array {
    return this.clothes[pane]?.scalars() ?? new Float32Array(0);
  }

  /** Pixels from the canvas's upper left corner to a vertex. */
  project(vertex: number, pane: number): { x: number; y: number } {
    return this.stage.grid.project(this.positions(pane), vertex, this.shown.indexOf(pane));
  }

  /** The picture as it is, as a PNG. */
  picture(): Promise<Blob | null> {
    return new Promise((resolve) => {
      this.onPicture = resolve;
      this.stage.redraw();
    });
  }

  private showLines(): void {
    for (const cloth of this.clothes) {
      cloth.setEdges(this.areEdgesShown, this.colours.line);
      cloth.setHanging(this.areHangingShown, this.colours.dot);
    }
    this.stage.redraw();
  }

  private follow(pelvis: Vector3): void {
    // The height stays: who squats goes down in the picture.
    const centre = new Vector3(pelvis.x, MIDDLE_M, pelvis.z);
    if (!this.isFramed) frame(this.stage, centre);
    this.isFramed = true;
    this.stage.control.follow(centre);
    this.stage.surroundings.follow(centre.x, centre.z);
  }

  private paneIn(place: number): number {
    return this.shown[place] ?? 0;
  }

  private prepare(pane: number): void {
    this.clothes.forEach((cloth, other) => {
      cloth.object.visible = other === pane && cloth.positions().length > 0;
    });
    this.clothes[pane]?.update();
  }

  private drawn(): void {
    if (this.onPicture) this.canvas.toBlob(this.onPicture);
    this.onPicture = null;
  }

  private setTheme(colour: (name: string) => string): void {
    this.body.setColour(colour('--stage-body'));
    this.colours = { line: colour('--mesh-line'), dot: colour('--mesh-dot') };
    this.showLines();
  }
}
