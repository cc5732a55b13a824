// JSON files that the page takes as text come without the spaces that make them readable.
import { readFileSync } from 'node:fs';
import type { Plugin } from 'vite';

const QUERY = '?raw';

export function compactJson(): Plugin {
  return {
    name: 'compact-json',
    enforce: 'pre',
    load(id) {
      if (!id.endsWith(`.json${QUERY}`)) return null;
      const path = id.slice(0, -QUERY.length);
      this.addWatchFile(path);
      const text = JSON.stringify(JSON.parse(readFileSync(path, 'utf8')));
      return `export default ${JSON.stringify(text)}`;
    },
  };
}
