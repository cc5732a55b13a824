// The base of every stage: one scene with floor and light, one camera under control, and a canvas
// that is cut into panes and drawn only when something changed.
import { type Object3D, PerspectiveCamera, Scene } from 'three';
import { createCameraControl } from './camera-control';
import { createCanvas } from './canvas';
import { createPaneGrid } from './pane-grid';
import { createSurroundings } from './surroundings';

export interface PaneStageParts {
  /** Angle of view from top to bottom [degrees]. */
  fov: number;
  objects: Object3D[];
  /** True when there is anything to be seen. */
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

  return { scene, camera, surroundings, grid, control, redraw, refit, open };
}
