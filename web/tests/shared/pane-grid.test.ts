import { PerspectiveCamera, type WebGLRenderer } from 'three';
import { describe, expect, it } from 'vitest';
import { createPaneGrid } from '../../src/shared/stage/pane-grid';

/** A canvas of 600 by 200 pixels whose upper left corner is at (30, 10) on the page. */
function create(nPanes: number, nColumns: number, width = 600, height = 200) {
  const canvas = {
    clientWidth: width,
    clientHeight: height,
    getBoundingClientRect: () => ({ left: 30, top: 10, width, height }),
  } as HTMLCanvasElement;
  const camera = new PerspectiveCamera(30, 1, 0.01, 100);
  const grid = createPaneGrid(canvas, camera);
  grid.set(nPanes, nColumns);
  return { camera, grid };
}

describe('pane grid', () => {
  it('finds each pane at its own middle and corner, and the first where there is none', () => {
    const { grid } = create(5, 3);
    for (let pane = 0; pane < 5; ++pane) {
      const { left, top, width, height } = grid.boxOf(pane);
      expect([width, height]).toEqual([200, 100]);
      expect(grid.paneAt({ x: left, y: top })).toBe(pane);
      expect(grid.paneAt({ x: left + width / 2, y: top + height / 2 })).toBe(pane);
    }
    expect(grid.boxOf(4)).toMatchObject({ left: 230, top: 110 });
    expect(grid.paneAt({ x: 530, y: 160 })).toBe(0); // no pane is right of the fifth
    expect(grid.paneAt({ x: 0, y: 0 })).toBe(0);
  });

  it('gives the camera the shape of a pane, and keeps it while the canvas is hidden', () => {
    const { camera, grid } = create(5, 3);
    grid.fit();
    expect(camera.aspect).toBe(2);
    const hidden = create(5, 3, 0, 0);
    hidden.grid.fit();
    expect(hidden.camera.aspect).toBe(1);
  });

  it('sees what is straight ahead in the middle of each pane, and what is higher above it', () => {
    const { camera, grid } = create(2, 2);
    grid.fit();
    camera.updateProjectionMatrix();
    camera.position.set(0, 0, 5);
    camera.updateMatrixWorld();
    const places = Float32Array.from([0, 0.5, 1, 0, 0, 1]);
    expect(grid.project(places, 1, 0)).toEqual({ x: 150, y: 100 });
    expect(grid.project(places, 1, 1)).toEqual({ x: 450, y: 100 });
    expect(grid.project(places, 0, 1).y).toBeLessThan(100);
  });

  it('draws every pane in its own part, counted from the lower left corner', () => {
    const { grid } = create(3, 2);
    const parts: Record<string, number[][]> = { viewport: [], scissor: [] };
    const renderer = {
      setScissorTest: () => undefined,
      setViewport: (...part: number[]) => parts.viewport?.push(part),
      setScissor: (...part: number[]) => parts.scissor?.push(part),
    } as unknown as WebGLRenderer;
    const drawn: number[] = [];
    grid.draw(renderer, (pane) => drawn.push(pane));
    expect(drawn).toEqual([0, 1, 2]);
    expect(parts.viewport).toEqual([
      [0, 100, 300, 100],
      [300, 100, 300, 100],
      [0, 0, 300, 100],
    ]);
    expect(parts.scissor).toEqual(parts.viewport);
  });
});
