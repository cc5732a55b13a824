// Parts of tables.
import { element } from './element';

export function heading(...words: string[]): HTMLElement {
  return element(
    'thead',
    {},
    element('tr', {}, ...words.map((word) => element('th', { scope: 'col' }, word))),
  );
}

export function numberCell(...text: (Node | string)[]): HTMLElement {
  return element('td', { class: 'number' }, ...text);
}

/** A row with its head before its cells. */
export function rowOf(
  head: string | readonly (Node | string)[],
  ...cells: HTMLElement[]
): HTMLElement {
  return element('tr', {}, element('th', { scope: 'row' }, ...[head].flat()), ...cells);
}
