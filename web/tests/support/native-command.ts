// The native command, to hold the modules against.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { ConvergenceStudy } from '../../src/motion/bindings/convergence-module';

const command = fileURLToPath(new URL('../../../build/release/cli/pleat', import.meta.url));

/** The levels that `pleat hierarchy` makes of a scene's cloth, and places of the coarsest one's vertices [m]. */
export function nativeLevels(scene: object, words: readonly string[]) {
  const folder = mkdtempSync(join(tmpdir(), 'pleat-native-'));
  try {
    const file = join(folder, 'scene.json');
    writeFileSync(file, JSON.stringify(scene));
    const out = join(folder, 'levels');
    const all = ['hierarchy', file, '--out', out, '--json', ...words];
    const { levels } = JSON.parse(execFileSync(command, all, { stdio: 'pipe', encoding: 'utf8' }));
    const name = readdirSync(out)
      .filter((one) => one.endsWith('.obj'))
      .sort()
      .at(-1);
    const lines = readFileSync(join(out, String(name)), 'utf8').split('\n');
    const points = lines.filter((line) => line.startsWith('v '));
    return {
      levels: (levels as { n_vertices: number; n_edges: number }[]).map(
        ({ n_vertices, n_edges }) => ({ n_vertices, n_edges }),
      ),
      coarsest: points.map((line) => line.split(' ').slice(1, 4).map(Number)),
    };
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** The answer of `pleat convergence` on one step of the scene. */
export function nativeConvergence(scene: object, words: readonly string[]): ConvergenceStudy {
  const folder = mkdtempSync(join(tmpdir(), 'pleat-native-'));
  try {
    const file = join(folder, 'scene.json');
    writeFileSync(file, JSON.stringify(scene));
    const all = ['convergence', file, '--json', ...words];
    return JSON.parse(execFileSync(command, all, { stdio: 'pipe', encoding: 'utf8' }));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** Runs the scene with these words; the answer is that of `read`, given what was printed and the folder. */
function ran<Found>(
  scene: object,
  words: readonly string[],
  read: (printed: string, folder: string) => Found,
): Found {
  const folder = mkdtempSync(join(tmpdir(), 'pleat-native-'));
  try {
    const file = join(folder, 'scene.json');
    writeFileSync(file, JSON.stringify(scene));
    const out = join(folder, 'run');
    const all = ['run', file, '--out', out, '--json', ...words];
    return read(execFileSync(command, all, { stdio: 'pipe', encoding: 'utf8' }), out);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** Positions after the last step, as `pleat run` writes them. */
export function nativePositions(scene: object): Float64Array {
  return ran(scene, [], (_, folder) => {
    const bytes = readFileSync(join(folder, 'frames.bin'));
    const { n_vertices: n } = JSON.parse(bytes.toString('utf8', 0, bytes.indexOf('\n')));
    const last = bytes.subarray(bytes.length - 24 * n);
    return new Float64Array(last.buffer.slice(last.byteOffset, last.byteOffset + last.byteLength));
  });
}

/** The account of energy of a run, as `pleat run --drift` tells it [J]. */
export function nativeEnergy(scene: object): Record<string, number> {
  return ran(scene, ['--drift'], (printed) => JSON.parse(printed).energy);
}
