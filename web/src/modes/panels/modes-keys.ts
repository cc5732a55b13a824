// The keys of the view of modes.
import { createKeyList } from '../../shared/panels/keys-panel';

const KEYS: readonly [string, string][] = [
  ['Space', 'play or pause'],
  ['M', 'modes or key frames'],
  ['1 to 9', 'that mode alone'],
  [', and .', 'back and on along the keys'],
  ['K', 'keep the mix as a key'],
  ['Arrows', 'turn the view'],
  ['+ and -', 'closer, farther'],
  ['Home', 'first view'],
];

export function createModesKeys(parent: HTMLElement): () => void {
  return createKeyList(parent, KEYS);
}
