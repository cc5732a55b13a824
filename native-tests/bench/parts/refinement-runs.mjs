// Scenes of garments, and the command's runs of them. An answer is kept in build/refinement, so
// that a bench that was stopped can go on where it was; another core or another scene asks anew.
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';

import { tell } from './bench-parts.mjs';
import { command, printed, root, withFiles } from './command.mjs';

const kFolder = join(root, 'build', 'refinement');

const readJson = (file) => JSON.parse(readFileSync(file, 'utf8'));

/** A garment's scene, its motion written out; `method` has values that take the place of its own. */
export function garmentScene(garment, motion, method = {}) {
  const file = join(root, 'assets', 'scenes', 'garments', `${garment}_${motion}.json`);
  const { $schema, ...scene } = readJson(file);
  return {
    ...scene,
    figure: { ...scene.figure, motion: readJson(join(dirname(file), scene.figure.motion)) },
    method: { ...scene.method, ...method },
  };
}

/** Whether answers of a bench that was stopped are taken; else all are asked anew. */
export const keptAnswers = { areTaken: false };
const asked = new Set();

/** The command's answer in JSON; words are texts, numbers, scenes or lists of scenes. */
export function answer(...words) {
  const version = printed('--version');
  const name = createHash('sha256')
    .update(JSON.stringify([version, words]))
    .digest('hex')
    .slice(0, 24);
  const file = join(kFolder, `${name}.json`);
  if ((keptAnswers.areTaken || asked.has(name)) && existsSync(file)) return readJson(file);
  const text = printed(...words);
  mkdirSync(kFolder, { recursive: true });
  writeFileSync(`${file}.part`, text);
  renameSync(`${file}.part`, file);
  asked.add(name);
  return JSON.parse(text);
}

/** Vertices of a scene's cloth; null where its measures are refused. */
function vertexCount(scene) {
  const one = { ...scene, duration_s: scene.method.step_s };
  try {
    return withFiles(['run', one, '--json'], (words) => {
      const text = execFileSync(command, words, {
        encoding: 'utf8',
        stdio: ['ignore', 'pipe', 'pipe'],
      });
      return JSON.parse(text).n_vertices;
    });
  } catch {
    return null;
  }
}

/** The scene on a uniform mesh of about so many vertices: other columns, and rows to match. */
export function uniformOfAbout(scene, n) {
  const [[kind, measures]] = Object.entries(scene.cloth.garment);
  const measured = (level, columns) => ({
    ...scene,
    cloth: { garment: { [kind]: { ...measures, columns } } },
    refinement: { level },
  });
  let best = null;
  for (const level of [1, 0]) {
    tell(`${scene.name}: a uniform mesh of about ${n} vertices`);
    const known = 40; // columns
    const about = known * Math.sqrt(n / vertexCount(measured(level, known)));
    for (let columns = 2 * Math.floor(about / 2) - 2; columns <= about + 4; columns += 2) {
      const candidate = measured(level, columns);
      const count = vertexCount(candidate);
      if (count !== null && (!best || Math.abs(count - n) < Math.abs(best.count - n)))
        best = { count, scene: candidate, columns, level };
    }
  }
  if (!best) throw new Error(`no uniform ${garment} of about ${n} vertices`);
  return best;
}
