// The native command, to hold the modules against.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const command = fileURLToPath(new URL('../../../build/release/cli/pleat', import.meta.url));

/** Positions after the last step, as `pleat run` writes them. */
export function nativePositions(scene: object): Float64Array {
  const folder = mkdtempSync(join(tmpdir(), 'pleat-native-'));
  try {
    const file = join(folder, 'scene.json');
    writeFileSync(file, JSON.stringify(scene));
    execFileSync(command, ['run', file, '--out', join(folder, 'run')], { stdio: 'pipe' });
    const bytes = readFileSync(join(folder, 'run', 'frames.bin'));
    const { n_vertices: n } = JSON.parse(bytes.toString('utf8', 0, bytes.indexOf('\n')));
    const last = bytes.subarray(bytes.length - 24 * n);
    return new Float64Array(last.buffer.slice(last.byteOffset, last.byteOffset + last.byteLength));
  } finally {
    rmSync(folder, { recursive: true });
  }
}
