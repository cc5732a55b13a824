// The base of every stage: one scene with floor and light, one camera under control, and a canvas
// that is cut into panes and drawn only when something changed.
import { type Object3D, PerspectiveCamera, Scene, Vector3 } from 'three';
import { createCameraControl } from './camera-control';
import { createCanvas } from './canvas';
import { createHand, type Hand, type HandEvents } from './grab';
import { createHandMark } from './hand-mark';
import { createPaneGrid } from './pane-grid';
import { createSurroundings } from './surroundings';

export interface PaneStageParts {
  /** Angle of view from top to bottom [degrees]. */
  fov: number;
  objects: Object3D[];
  /** Whether there is anything to be seen. */
  isReady(): boolean;
  /** Puts into the scene what a pane shows, just before it is drawn. */
  prepare(pane: number): void;
  /** Hears of each picture. */
  drawn(): void;
  /** `colour` reads a variable of the page's design. */
  themed(colour: (name: string) => string): void;
  /** Keys that go before the camera's, as those of a hand. True when used. */
  handKey?(name: string): boolean;
  /** Keys that are not the camera's. True when used. */
  key(name: string): boolean;
  pictureLost(isLost: boolean): void;
}

export type PaneStage = ReturnType<typeof createPaneStage>;

/** Draws into `canvas`, which fills `parent`. Throws when the browser has no WebGL 2. */
export function createPaneStage(
  parent: HTMLElement,
  canvas: HTMLCanvasElement,
  parts: PaneStageParts,
) {
  const scene = new Scene();
  const camera = new PerspectiveCamera(parts.fov, 1, 0.01, 100);
  const surroundings = createSurroundings();
  scene.add(surroundings.object, ...parts.objects);
  const grid = createPaneGrid(canvas, camera);

  const { redraw, open } = createCanvas(parent, canvas, {
    draw(renderer) {
      if (canvas.clientWidth === 0 || !parts.isReady()) return;
      grid.draw(renderer, (pane) => {
        parts.prepare(pane);
        renderer.render(scene, camera);
      });
      parts.drawn();
    },
    resized: refit,
    themed(colour) {
      surroundings.setTheme(colour);
      parts.themed(colour);
    },
    key: (name) => parts.handKey?.(name) || control.key(name) || parts.key(name),
    pictureLost: parts.pictureLost,
  });
  const control = createCameraControl(canvas, camera, redraw, grid.paneHeight);

  /** Gives the camera the shape of a pane. */
  function refit(): void {
    grid.fit();
    control.refit();
  }

  return { scene, camera, surroundings, grid, control, canvas, redraw, refit, open };
}

/** A hand on a stage, with its mark; while it holds the cloth, the camera rests. */
export function createStageHand(
  stage: PaneStage,
  events: Omit<HandEvents, 'onChange'>,
): Hand & {
  /** Marks the hand at the held vertex of these positions, or nowhere. */
  mark(positions: Float32Array | null): void;
  setColour(colour: string): void;
} {
  const { scene, camera, control, canvas, redraw } = stage;
  const mark = createHandMark();
  scene.add(mark.object);
  const hand = createHand(canvas, camera, {
    ...events,
    grab(vertex) {
      control.setResting(true);
      events.grab(vertex);
    },
    release() {
      control.setResting(false);
      events.release();
    },
    onChange: redraw,
  });
  return {
    ...hand,
    drop() {
      hand.drop();
      control.setResting(false);
    },
    mark(positions) {
      const vertex = hand.vertex();
      const isHeld = positions !== null && vertex !== null;
      const place = isHeld ? new Vector3().fromArray(positions, 3 * vertex) : null;
      mark.place(place, hand.target(), camera);
    },
    setColour: mark.setColour,
  };
}
