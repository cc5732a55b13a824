// Parts of plots: their frame, and the lines, numbers and titles of their axes.
import { svg } from './element';

/** An empty plot, whose words stand beside it for those who do not see it. */
export function createPlot(width: number, height: number, kind = ''): SVGElement {
  const viewBox = `0 0 ${width} ${height}`;
  return svg('svg', { viewBox, class: `plot ${kind}`.trim(), 'aria-hidden': 'true' });
}

export function plotText(kind: string, x: number, y: number, words: string): SVGElement {
  return svg('text', { x, y, class: kind }, words);
}

/** The title of an axis of values, written upward around its middle. */
export function uprightTitle(x: number, y: number, words: string): SVGElement {
  return svg('text', { x, y, class: 'axis', transform: `rotate(-90 ${x} ${y})` }, words);
}

/** A level line with its number, which ends so far before it. */
export function levelMarks(
  [left, right]: readonly [number, number],
  y: number,
  words: string,
  gap: number,
  kind = 'grid-minor',
): SVGElement[] {
  return [
    svg('line', { x1: left, y1: y, x2: right, y2: y, class: kind }),
    plotText('tick tick-y', left - gap, y + 4, words),
  ];
}
