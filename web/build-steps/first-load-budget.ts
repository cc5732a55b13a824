// Prints what a first visit downloads, gzipped, and fails the build when it is too much.
import { gzipSync } from 'node:zlib';
import type { Plugin } from 'vite';

/**
 * Fetched only when it is asked for: meshes, references, records, what a sweep needs, and the views of
 * fabrics and of refinement.
 */
const LATER =
  /\.(map|obj|reference|recording)$|(^|\/)(sweep|deform|fabrics-view|refinement|refinement-view|garment-worker|example-worker|plan)[-.]/;

/** Bounds of a first load, gzipped [kB]. */
const BOUNDS_KB = { page: 200, wasm: 350 };

function gzippedKilobytes(content: string | Uint8Array): number {
  return gzipSync(content).length / 1000;
}

export function firstLoadBudget(): Plugin {
  return {
    name: 'first-load-budget',
    apply: 'build',
    enforce: 'post',
    generateBundle: {
      order: 'post',
      handler(_options, bundle) {
        const sums = { page: 0, wasm: 0 };
        for (const output of Object.values(bundle)) {
          if (LATER.test(output.fileName)) continue;
          const content = output.type === 'chunk' ? output.code : output.source;
          const kind = output.fileName.endsWith('.wasm') ? 'wasm' : 'page';
          sums[kind] += gzippedKilobytes(content);
        }
        for (const kind of ['page', 'wasm'] as const) {
          const sentence = `first load, ${kind}: ${sums[kind].toFixed(1)} kB gzipped, at most ${BOUNDS_KB[kind]} kB`;
          if (sums[kind] > BOUNDS_KB[kind]) this.error(`${sentence}: too much`);
          this.info(sentence);
        }
      },
    },
  };
}
