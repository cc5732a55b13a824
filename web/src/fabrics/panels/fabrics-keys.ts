// The keys of the view of fabrics.
import { createKeyList } from '../../shared/panels/keys-panel';

const KEYS: readonly [string, string][] = [
  ['G', 'take the cloth at the middle of the chosen picture; then arrows, Page Up and Page Down'],
  ['G or Escape', 'let go: the handle stays'],
  ['P', 'change between pulling and pinning'],
  ['1 to 4', 'choose a picture'],
  ['Arrows', 'turn the view'],
  ['+ and -', 'closer, farther'],
  ['Home', 'first view'],
];

export function createFabricsKeys(parent: HTMLElement): () => void {
  return createKeyList(parent, KEYS);
}
