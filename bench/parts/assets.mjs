// Files of assets/, as benches use them.
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

export const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..');
export const asset = (...path) => join(root, 'assets', ...path);
export const readJson = (file) => JSON.parse(readFileSync(file, 'utf8'));
export const fabricsText = () => readFileSync(asset('fabrics', 'fabrics.json'), 'utf8');

/**
 * A shipped scene by its path in assets/scenes, to be read from anywhere: files of JSON that it
 * names stand in it, and a mesh has its whole path.
 */
export function shippedScene(name) {
  const file = asset('scenes', `${name}.json`);
  const { $schema, ...scene } = readJson(file);
  const path = (named) => join(dirname(file), named);
  const { mesh } = scene.cloth;
  if (mesh?.obj) mesh.obj = path(mesh.obj);
  if (scene.figure) scene.figure.motion = readJson(path(scene.figure.motion));
  if (scene.start) scene.start = readJson(path(scene.start));
  return scene;
}

/** A garment's scene; `method` has values that take the place of its own. */
export function garmentScene(garment, motion, method = {}) {
  const scene = shippedScene(join('garments', `${garment}_${motion}`));
  return { ...scene, method: { ...scene.method, ...method } };
}

/** The scene with values at JSON pointers; objects that are missing on the way are made. */
export function changed(scene, changes) {
  const result = structuredClone(scene);
  for (const [pointer, value] of Object.entries(changes)) {
    const keys = pointer.slice(1).split('/');
    const last = keys.pop();
    let place = result;
    for (const key of keys) place = place[key] ??= {};
    place[last] = value;
  }
  return result;
}
