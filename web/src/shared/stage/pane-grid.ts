// A canvas cut into panes of one size, row by row; one camera sees each of them.
import { type PerspectiveCamera, Vector3, type WebGLRenderer } from 'three';
import type { Box } from './grab';

export function createPaneGrid(canvas: HTMLCanvasElement, camera: PerspectiveCamera) {
  let nPanes = 1;
  let nColumns = 1;
  let nRows = 1;

  function cut(pane: number, { left, top, width, height }: Box): Box {
    const [w, h] = [width / nColumns, height / nRows];
    return {
      left: left + (pane % nColumns) * w,
      top: top + Math.floor(pane / nColumns) * h,
      width: w,
      height: h,
    };
  }

  /** A pane's box on the canvas. */
  function cutCanvas(pane: number): Box {
    return cut(pane, { left: 0, top: 0, width: canvas.clientWidth, height: canvas.clientHeight });
  }

  /** A pane's box on the page. */
  function boxOf(pane: number): Box {
    return cut(pane, canvas.getBoundingClientRect());
  }

  return {
    boxOf,
    /** Shows so many panes, `columns` of them side by side. */
    set(panes: number, columns: number): void {
      nPanes = panes;
      nColumns = columns;
      nRows = Math.max(1, Math.ceil(panes / columns));
    },
    /** Gives the camera the shape of a pane, where there is any canvas to be seen. */
    fit(): void {
      const { width, height } = cutCanvas(0);
      if (width > 0 && height > 0) camera.aspect = width / height;
    },
    /** Height of a pane in CSS pixels. */
    paneHeight: () => canvas.clientHeight / nRows,
    /** The pane at a point of the page, or the first. */
    paneAt({ x, y }: { x: number; y: number }): number {
      for (let pane = 0; pane < nPanes; ++pane) {
        const { left, top, width, height } = boxOf(pane);
        if (x >= left && x < left + width && y >= top && y < top + height) return pane;
      }
      return 0;
    },
    /** Pixels from the canvas's upper left corner to a vertex in a pane. */
    project(positions: Float32Array, vertex: number, pane: number): { x: number; y: number } {
      const place = new Vector3().fromArray(positions, 3 * vertex).project(camera);
      const { left, top, width, height } = cutCanvas(pane);
      return { x: left + ((place.x + 1) / 2) * width, y: top + ((1 - place.y) / 2) * height };
    },
    /** Calls `render` for each pane, with the renderer set to its part of the canvas. */
    draw(renderer: WebGLRenderer, render: (pane: number) => void): void {
      renderer.setScissorTest(true);
      for (let pane = 0; pane < nPanes; ++pane) {
        const { left, top, width, height } = cutCanvas(pane);
        const bottom = canvas.clientHeight - top - height;
        renderer.setViewport(left, bottom, width, height);
        renderer.setScissor(left, bottom, width, height);
        render(pane);
      }
    },
  };
}
