// Adds the service worker that keeps a copy of the built page for use without a network.
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import type { Plugin } from 'vite';

const SOURCE = new URL('./offline-worker.js', import.meta.url);

export function offlineCopy(): Plugin {
  return {
    name: 'offline-copy',
    apply: 'build',
    generateBundle: {
      order: 'post',
      handler(_options, bundle) {
        // References and records are large, and the page goes without them.
        const files = Object.keys(bundle)
          .filter((name) => !/\.(reference|recording)$/.test(name))
          .sort();
        const hash = createHash('sha256');
        for (const name of files) {
          const output = bundle[name];
          if (output) hash.update(output.type === 'chunk' ? output.code : output.source);
        }
        const version = hash.digest('hex').slice(0, 12);
        const list = JSON.stringify({ version, files: ['./', ...files] });
        const source = `const COPY = ${list};\n${readFileSync(SOURCE, 'utf8')}`;
        this.emitFile({ type: 'asset', fileName: 'offline.js', source });
      },
    },
  };
}
