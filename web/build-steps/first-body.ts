// The body as the view of refinement starts with it, which stands there before anything of the view could be
// fetched: asked of the module that was built for the page.
import { readFileSync } from 'node:fs';
import type { Plugin } from 'vite';
import type { RefinementModule } from '../src/refinement/bindings/refinement-module.ts';
import { FIRST_PICTURE } from '../src/refinement/state/garment-frames.ts';
import { builtCore } from './built-core.ts';

const NAME = 'virtual:pleat-body';
const ASSETS = new URL('../../assets/', import.meta.url);
const FOLDER = 'scenes/garments/';
const SCENE = `${FIRST_PICTURE.garment}_${FIRST_PICTURE.motion}.json`;

/** Digits of a length [m] that can be seen. */
const DIGITS = 4;

const textOf = (path: string) => readFileSync(new URL(path, ASSETS), 'utf8');

async function solidsAtStart(): Promise<unknown> {
  const { GarmentRun } = await builtCore<RefinementModule>();
  const run = new GarmentRun(textOf('fabrics/fabrics.json'));
  const scene = { ...JSON.parse(textOf(FOLDER + SCENE)), refinement: { level: 0 } };
  const named: string[] = [scene.figure.motion, scene.start];
  const files = Object.fromEntries(named.map((name) => [name, textOf(FOLDER + name)]));
  const { ok, message } = JSON.parse(run.load(JSON.stringify(scene), files));
  if (!ok) throw new Error(`${SCENE}: ${message}`);
  run.put(run.positions().slice(), FIRST_PICTURE.startS);
  const { cones, pelvis_m } = JSON.parse(run.solids());
  run.delete();
  return { cones, pelvis_m };
}

const rounded = (_: string, value: unknown) =>
  typeof value === 'number' ? Number(value.toFixed(DIGITS)) : value;

export function firstBody(): Plugin {
  return {
    name: 'pleat-body',
    resolveId: (id) => (id === NAME ? `\0${NAME}` : null),
    load: async (id) =>
      id === `\0${NAME}`
        ? `export default ${JSON.stringify(await solidsAtStart(), rounded)}`
        : null,
  };
}
