// The keys, for those who do not use a pointer.
import { element } from './element';
import { addSection, folded, noteLine } from './section';

export type Keys = readonly (readonly [string, string])[];

/** Keys that turn the view. */
export const VIEW_KEYS: Keys = [
  ['Arrows', 'turn the view'],
  ['+ and -', 'closer, farther'],
  ['Home', 'first view'],
];

/** Keys of a run that is looked at. */
export const RUN_KEYS: Keys = [
  ['Space', 'play or pause'],
  ['.', 'one step'],
  ['R', 'reset'],
  ...VIEW_KEYS,
];

/** Keys of a run whose cloth can be taken. */
export const HAND_KEYS: Keys = [
  ...RUN_KEYS,
  ['G', 'take the cloth at the middle of the picture; then arrows, Page Up and Page Down move it'],
  ['G or Escape', 'let go'],
];

export function createKeyList(parent: HTMLElement, keys: Keys): void {
  const list = element('dl', { class: 'keys' });
  for (const [key, meaning] of keys) {
    list.append(element('dt', {}, element('kbd', {}, key)), element('dd', {}, meaning));
  }
  const box = folded('Keys', {}, noteLine('They work while the picture has the focus.'), list);
  addSection(parent, 'Keys', box);
}
