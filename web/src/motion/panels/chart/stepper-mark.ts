// The mark and colours of a stepper in charts.
import './stepper-mark.css';
import { element, svg } from '../../../shared/panels/element';
import { STEPPERS } from '../../../shared/steppers/steppers';

/** The mark of a stepper about the origin, and a style with its colours; a plus for an unknown one. */
export function markOf(name: string): { path: string; style: string } {
  const row = STEPPERS.find((one) => one.name === name);
  if (!row) return { path: 'M-5 0H5M0-5V5', style: '' };
  return { path: row.mark, style: `--mark: ${row.colour}; --mark-dark: ${row.dark_colour}` };
}

/** A line of a legend: a drawing about the origin, and what it means. */
export function legendItem(paths: Record<string, string>, words: string, style = ''): HTMLElement {
  const picture = svg('svg', { viewBox: '-8 -8 16 16', 'aria-hidden': 'true' });
  for (const [kind, d] of Object.entries(paths)) picture.append(svg('path', { class: kind, d }));
  return element('li', { style }, picture, words);
}
