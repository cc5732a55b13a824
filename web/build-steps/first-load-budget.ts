// Prints what a first visit downloads and how large each module is, gzipped, and fails the build when that
// is too much.
import { gzipSync } from 'node:zlib';
import type { Plugin, Rolldown } from 'vite';

/** Most of a first load's page, gzipped [kB]. */
const MOST_PAGE_KB = 200;

/** Most of any one WebAssembly module, of the first load or of a later view, gzipped [kB]. */
const MOST_MODULE_KB = 450;

/**
 * Assets that are fetched only when they are asked for: meshes, references, records, starts, and the workers of
 * a sweep and of the later views. Of chunks and styles the first load has what the entry imports.
 */
const LATER =
  /\.(map|obj|reference|recording|wasm|css)$|(^|\/)(sweep|obj|measuring|convergence|deform|garment|example|modal|failures)-worker-|(^|\/)(plan|floor|(skirt|(slim_)?trousers)(_even)?)-/;

type Bundle = Rolldown.OutputBundle;

function gzippedKilobytes(output: Bundle[string]): number {
  return gzipSync(output.type === 'chunk' ? output.code : output.source).length / 1000;
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
        for (const [name, output] of Object.entries(bundle)) {
          const isFirst = first.has(name) || (output.type === 'asset' && !LATER.test(name));
          if (isFirst) page += gzippedKilobytes(output);
          if (name.endsWith('.wasm'))
            hold(`module ${name}`, gzippedKilobytes(output), MOST_MODULE_KB);
        }
        hold('first load, page', page, MOST_PAGE_KB);
      },
    },
  };
}
