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

  it('have programs of the page that take its code as Vite makes it', () => {
    const here = new URL('./', import.meta.url);
    const programs = readdirSync(here).filter((name) => !name.endsWith('.test.mjs'));
    const direct = programs.filter((name) =>
      readFileSync(new URL(name, here), 'utf8').includes("from '../../src/"),
    );
    expect(programs.length).toBeGreaterThan(4);
    expect(direct).toEqual([]);
  });
});
