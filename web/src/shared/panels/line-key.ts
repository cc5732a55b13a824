// Look of a line of a chart, for a list of marks.
import './line-key.css';
import { element, svg } from './element';

/** A piece of the line, which `kind` styles, and its title. */
export function lineKey(kind: string, title: string): HTMLElement {
  const mark = svg('svg', { viewBox: '0 0 24 10', 'aria-hidden': 'true' });
  mark.append(svg('path', { d: 'M0 5H24', class: kind }));
  return element('li', {}, mark, title);
}
