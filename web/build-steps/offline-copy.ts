// Adds the service worker that keeps a copy of the built page for use without a network.
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import type { Plugin } from 'vite';

const SOURCE = new URL('./offline-worker.js', import.meta.url);

/** References, records and starts are large: each is kept once a visitor has fetched it. */
const ON_DEMAND = /\.(reference|recording)$|(skirt|trousers)(_even)?-[^/]*\.json$/;

export function offlineCopy(): Plugin {
  return {
    name: 'offline-copy',
    apply: 'build',
    generateBundle: {
      order: 'post',
      handler(_options, bundle) {
        const names = Object.keys(bundle).sort();
        const files = names.filter((name) => !ON_DEMAND.test(name));
        const onDemand = names.filter((name) => ON_DEMAND.test(name));
        const hash = createHash('sha256');
        for (const name of files) {
          const output = bundle[name];
          if (output) hash.update(output.type === 'chunk' ? output.code : output.source);
        }
        const version = hash.digest('hex').slice(0, 12);
        const list = JSON.stringify({ version, files: ['./', ...files], onDemand });
        const source = `const COPY = ${list};\n${readFileSync(SOURCE, 'utf8')}`;
        this.emitFile({ type: 'asset', fileName: 'offline.js', source });
      },
    },
  };
}
