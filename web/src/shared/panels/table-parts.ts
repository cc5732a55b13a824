// Parts of tables.
import { element } from './element';

/** A table with a caption for those who do not see it. */
export function tableOf(kind: string, caption: string, ...parts: HTMLElement[]): HTMLElement {
  const words = element('caption', { class: 'unseen' }, caption);
  return element('table', { class: kind }, words, ...parts);
}

/** The heads of a column of names and of columns of numbers. */
export function heading(...titles: string[]): HTMLElement {
  const cells = titles.map((title, column) =>
    element('th', { scope: 'col', class: column > 0 ? 'number' : false }, title),
  );
  return element('thead', {}, element('tr', {}, ...cells));
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
