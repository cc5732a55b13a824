// JSON files that the page takes as text come without the spaces that make them readable, and without what
// is for their readers alone.
import { readFileSync } from 'node:fs';
import type { Plugin } from 'vite';

const QUERY = '?raw';

/** Notes of the fabric file that the page and its module read. */
const READ_OF_META = ['sources', 'confidence'];

function fabricsRead({ meta, fabrics }: { meta: object; fabrics: unknown }): object {
  const read = Object.entries(meta).filter(([key]) => READ_OF_META.includes(key));
  return { meta: Object.fromEntries(read), fabrics };
}

export function compactJson(): Plugin {
  return {
    name: 'compact-json',
    enforce: 'pre',
    load(id) {
      if (!id.endsWith(`.json${QUERY}`)) return null;
      const path = id.slice(0, -QUERY.length);
      this.addWatchFile(path);
      const whole = JSON.parse(readFileSync(path, 'utf8'));
      const text = JSON.stringify(path.endsWith('/fabrics.json') ? fabricsRead(whole) : whole);
      return `export default ${JSON.stringify(text)}`;
    },
  };
}
