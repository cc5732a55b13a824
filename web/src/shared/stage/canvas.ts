// A canvas that fills its parent, follows the page's theme, and is drawn only when it is asked for.
import { PCFShadowMap, SRGBColorSpace, WebGLRenderer } from 'three';

export interface CanvasEvents {
  draw(renderer: WebGLRenderer): void;
  /** Size of the parent in CSS pixels; both positive. */
  resized(width: number, height: number): void;
  /** `colour` reads a variable of the page's design. */
  themed(colour: (name: string) => string): void;
  /** True when the key was used. `name` has letters in lower case. */
  key(name: string): boolean;
  /** The browser took the graphics away, or gave them back. */
  pictureLost(isLost: boolean): void;
}

/** Sharper than this no display at arm's length looks, and it costs the square. */
const MOST_PIXEL_RATIO = 2;

/** Throws when the browser has no WebGL 2. */
export function createCanvas(parent: HTMLElement, canvas: HTMLCanvasElement, events: CanvasEvents) {
  const renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
  renderer.outputColorSpace = SRGBColorSpace;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = PCFShadowMap;
  let drawHandle = 0;

  function redraw(): void {
    if (drawHandle !== 0) return;
    drawHandle = requestAnimationFrame(() => {
      drawHandle = 0;
      events.draw(renderer);
    });
  }

  function resize(): void {
    const { clientWidth: width, clientHeight: height } = parent;
    if (width === 0 || height === 0) return;
    renderer.setPixelRatio(Math.min(window.devicePixelRatio, MOST_PIXEL_RATIO));
    renderer.setSize(width, height, false);
    events.resized(width, height);
    events.draw(renderer); // a canvas of another size is empty until then
  }

  function applyTheme(): void {
    const style = getComputedStyle(document.documentElement);
    events.themed((name) => style.getPropertyValue(name).trim());
    redraw();
  }

  canvas.addEventListener('webglcontextlost', (event) => {
    event.preventDefault();
    events.pictureLost(true);
  });
  canvas.addEventListener('webglcontextrestored', () => {
    events.pictureLost(false);
    redraw();
  });
  canvas.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const name = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (events.key(name)) event.preventDefault();
  });

  return {
    /** Draws with the next frame of the display. */
    redraw,
    /** Call once everything that draws is there. */
    open() {
      new ResizeObserver(resize).observe(parent);
      window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', applyTheme);
      resize();
      applyTheme();
    },
  };
}
