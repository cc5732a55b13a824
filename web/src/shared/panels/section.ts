// Parts of a panel.
import { type Attributes, element } from './element';

/** Adds a part to a panel; its label is told to those who do not see where it begins. */
export function addSection(
  panel: HTMLElement,
  label: string,
  ...children: (Node | string)[]
): HTMLElement {
  const section = element('section', { 'aria-label': label }, ...children);
  panel.append(section);
  return section;
}

/** A part that is folded away behind its summary. */
export function folded(summary: string, attributes: Attributes, ...children: (Node | string)[]) {
  return element('details', attributes, element('summary', {}, summary), ...children);
}

export function noteLine(...words: (Node | string)[]): HTMLElement {
  return element('p', { class: 'note' }, ...words);
}
