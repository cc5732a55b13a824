// The addresses of the references that sweeps are compared with, by their ids. A chunk of its own: only
// who measures fetches it.
const FILES = import.meta.glob<string>('../../../../assets/references/sweep/*/*.reference', {
  query: '?url',
  import: 'default',
  eager: true,
});

const idOf = (path: string) => path.replace(/^.*\//, '').replace(/\.reference$/, '');

export const LADDER_FILES: ReadonlyMap<string, string> = new Map(
  Object.entries(FILES).map(([path, url]) => [idOf(path), url]),
);
