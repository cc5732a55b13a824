// Shipped scenes run by the module, and their vertices by what is true of them at rest.
import { readFileSync } from 'node:fs';
import { expect } from 'vitest';
import type { PleatModule, SimulationHandle } from '../../src/shared/bindings/pleat-module';
import { fabricsText } from '../../src/shared/fabric/fabric-data';

const ASSETS = new URL('../../../assets/', import.meta.url);

export const textOf = (path: string) => readFileSync(new URL(path, ASSETS), 'utf8');

export const STEPS_PER_SECOND = 60;

interface Scene {
  caption: string;
  [part: string]: unknown;
}

export interface Vertex {
  id: number;
  x: number;
  y: number;
  z: number;
}

export const sceneOf = (name: string) => JSON.parse(textOf(`scenes/${name}.json`)) as Scene;

export function verticesOf(simulation: SimulationHandle): Vertex[] {
  const places = simulation.exactPositions();
  return Array.from({ length: places.length / 3 }, (_, id) => {
    const [x = 0, y = 0, z = 0] = places.subarray(3 * id, 3 * id + 3);
    return { id, x, y, z };
  });
}

/** A scene that has begun; `at` runs on to a time and gives the vertices there [s]. */
export function begin(module: PleatModule, scene: object) {
  const simulation = new module.Simulation(fabricsText);
  expect(JSON.parse(simulation.load(JSON.stringify(scene)))).toMatchObject({ ok: true });
  const rest = verticesOf(simulation);
  let nDone = 0;
  return {
    simulation,
    rest,
    at(time: number): Vertex[] {
      const nSteps = Math.round(time * STEPS_PER_SECOND);
      expect(simulation.step(nSteps - nDone)).toBe(0);
      nDone = nSteps;
      return verticesOf(simulation);
    },
  };
}

export const mean = (values: number[]) =>
  values.reduce((sum, value) => sum + value, 0) / values.length;
export const span = (values: number[]) => Math.max(...values) - Math.min(...values);
export const isNear = (a: number, b: number) => Math.abs(a - b) < 1e-6;

/** The vertices that satisfy `test` at rest, as they are in `now`. */
export function those(rest: Vertex[], now: Vertex[], test: (vertex: Vertex) => boolean): Vertex[] {
  return rest.filter(test).map(({ id }) => now[id] as Vertex);
}
