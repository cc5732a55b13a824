// Parts of the small tables of the view of refinement.
import { element } from '../../shared/panels/element';

export function heading(...words: string[]): HTMLElement {
  return element(
    'thead',
    {},
    element('tr', {}, ...words.map((word) => element('th', { scope: 'col' }, word))),
  );
}

export function numberCell(text: string): HTMLElement {
  return element('td', { class: 'number' }, text);
}
