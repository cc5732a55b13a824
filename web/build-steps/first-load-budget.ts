// Prints what visits download, gzipped, and fails the build when that is too much.
import { brotliCompressSync, gzipSync } from 'node:zlib';
import type { Plugin, Rolldown } from 'vite';

/** Most of a first load's page, gzipped [kB]. */
const MOST_PAGE_KB = 200;

/** Most of the WebAssembly of a first visit and of all, gzipped [kB]. */
const MOST_FIRST_MODULE_KB = 600;
const MOST_MODULES_KB = 1000;

/**
 * Assets that are fetched only when they are asked for: meshes, references, records, starts, and the workers of
 * a sweep and of the later views. Of chunks and styles the first load has what the entry imports.
 */
const LATER =
  /\.(map|obj|reference|recording|wasm|css)$|(^|\/)(sweep|obj|measuring|convergence|deform|garment|example|modal)-worker-|(^|\/)(plan|floor|(skirt|(slim_)?trousers)(_even)?)-/;

type Bundle = Rolldown.OutputBundle;

const bytesOf = (output: Bundle[string]) => (output.type === 'chunk' ? output.code : output.source);

function gzippedKilobytes(output: Bundle[string]): number {
  return gzipSync(bytesOf(output)).length / 1000;
}

/** The entry with everything that it imports before it runs, and their styles. */
function firstChunks(bundle: Bundle): Set<string> {
  const found = new Set<string>();
  const add = (name: string): void => {
    const output = bundle[name];
    if (!output || found.has(name)) return;
    found.add(name);
    if (output.type !== 'chunk') return;
    for (const other of [...output.imports, ...(output.viteMetadata?.importedCss ?? [])])
      add(other);
  };
  for (const [name, output] of Object.entries(bundle))
    if (output.type === 'chunk' && output.isEntry) add(name);
  return found;
}

export function firstLoadBudget(): Plugin {
  return {
    name: 'first-load-budget',
    apply: 'build',
    enforce: 'post',
    generateBundle: {
      order: 'post',
      handler(_options, bundle) {
        const hold = (what: string, kilobytes: number, most: number) => {
          const sentence = `${what}: ${kilobytes.toFixed(1)} kB gzipped, at most ${most} kB`;
          if (kilobytes > most) this.error(`${sentence}: too much`);
          this.info(sentence);
        };
        const first = firstChunks(bundle);
        let page = 0;
        let firstModule = 0;
        let modules = 0;
        for (const [name, output] of Object.entries(bundle)) {
          const isFirst = first.has(name) || (output.type === 'asset' && !LATER.test(name));
          if (isFirst) page += gzippedKilobytes(output);
          if (!name.endsWith('.wasm')) continue;
          const gzipped = gzippedKilobytes(output);
          const brotli = brotliCompressSync(bytesOf(output)).length / 1000;
          this.info(
            `module ${name}: ${gzipped.toFixed(1)} kB gzipped, ${brotli.toFixed(1)} kB by Brotli`,
          );
          modules += gzipped;
          if (!name.includes('pleat-rest')) firstModule += gzipped;
        }
        hold('WebAssembly of a first visit', firstModule, MOST_FIRST_MODULE_KB);
        hold('all WebAssembly', modules, MOST_MODULES_KB);
        hold('first load, page', page, MOST_PAGE_KB);
      },
    },
  };
}
