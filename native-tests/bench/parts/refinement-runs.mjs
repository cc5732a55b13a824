// Scenes of garments, and the command's runs of them. An answer is kept in build/refinement, so
// that a bench that was stopped can go on where it was; another core or another scene asks anew.
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import {
  existsSync,
  mkdirSync,
  mkdtempSync,
  readFileSync,
  renameSync,
  rmSync,
  writeFileSync,
} from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';

import { tell } from './bench-parts.mjs';
import { command, printed, root, withFiles } from './command.mjs';

const kFolder = join(root, 'build', 'refinement');
const kSettling = { durationS: 12, airKgPerM3: 20, standingS: 1000 };

const readJson = (file) => JSON.parse(readFileSync(file, 'utf8'));

/**
 * A garment's scene, the files that it names written out; `method` has values that take the place
 * of its own.
 */
export function garmentScene(garment, motion, method = {}) {
  const file = join(root, 'assets', 'scenes', 'garments', `${garment}_${motion}.json`);
  const { $schema, ...scene } = readJson(file);
  const named = (name) => readJson(join(dirname(file), name));
  return {
    ...scene,
    figure: { ...scene.figure, motion: named(scene.figure.motion) },
    start: named(scene.start),
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
  const { start: _, ...unsettled } = scene; // of another mesh
  const [[kind, measures]] = Object.entries(scene.cloth.garment);
  const measured = (level, columns) => ({
    ...unsettled,
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
  if (!best) throw new Error(`no uniform mesh of about ${n} vertices for ${scene.name}`);
  return { ...best, scene: { ...best.scene, start: settled(best.scene) } };
}

/** Where a garment settles on the standing figure: as assets/starts/README.md has it. */
function settled(scene) {
  const air = { ...scene.world.air, density_kg_per_m3: kSettling.airKgPerM3 };
  const standing = {
    ...scene,
    figure: { ...scene.figure, blend_time_s: kSettling.standingS },
    world: { ...scene.world, air },
    duration_s: kSettling.durationS,
  };
  const folder = mkdtempSync(join(tmpdir(), 'pleat-settled-'));
  const file = join(folder, 'state.json');
  tell(`${scene.name}: it settles`);
  printed('run', standing, '--state', file);
  const { positions_m } = readJson(file);
  rmSync(folder, { recursive: true });
  return { positions_m };
}
