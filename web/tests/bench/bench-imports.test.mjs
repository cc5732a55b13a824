import { readdirSync, readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';

const bench = new URL('../../../bench/', import.meta.url);

describe('benches', () => {
  it('import nothing of the page and of its tests, which may import them', () => {
    const files = readdirSync(bench, { recursive: true }).filter((name) => name.endsWith('.mjs'));
    const imports = files.flatMap((name) => {
      const text = readFileSync(new URL(name, bench), 'utf8');
      return [...text.matchAll(/^(?:import .*?|\} from )'([^'\n]+)'/gm)].map((found) => found[1]);
    });
    expect(imports.length).toBeGreaterThan(files.length);
    const outside = imports.filter((path) => !/^(\.\/[\w./-]+\.mjs|node:[\w/]+)$/.test(path));
    expect(outside).toEqual([]);
  });
});
