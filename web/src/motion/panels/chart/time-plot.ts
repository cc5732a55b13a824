// Quantities over time, as lines.
import './time-plot.css';
import { type SpanScale, spanScale } from '../../../shared/chart/linear-scale';
import { pathThrough } from '../../../shared/chart/path-through';
import { svg } from '../../../shared/panels/element';

const WIDTH = 360;
const HEIGHT = 230;
const LEFT = 62;
const RIGHT = 18;
const TOP = 10;
const BOTTOM = 40;
const N_LEVELS = 7;

export interface TimeLine {
  class: string;
  /** One for each time. */
  values: readonly number[];
}

export interface TimeChart {
  timeTitle: string;
  valueTitle: string;
  times: readonly number[];
  lines: readonly TimeLine[];
}

/** A round number, with a true minus. */
function numeral(tick: number): string {
  return String(tick).replace('-', '−');
}

function levels(scale: SpanScale, y: (value: number) => number): SVGElement[] {
  return scale.ticks.flatMap((tick) => [
    svg('line', {
      x1: LEFT,
      y1: y(tick),
      x2: WIDTH - RIGHT,
      y2: y(tick),
      class: tick === 0 ? 'grid' : 'grid-minor',
    }),
    svg('text', { x: LEFT - 6, y: y(tick) + 4, class: 'tick tick-y' }, numeral(tick)),
  ]);
}

/** The axis of values holds zero. */
function draw(root: SVGElement, { timeTitle, valueTitle, times, lines }: TimeChart): void {
  const [begin, end] = [times[0] ?? 0, times.at(-1) ?? 1];
  const upward = spanScale([0, ...lines.flatMap(({ values }) => values)], N_LEVELS);
  const right = WIDTH - RIGHT;
  const bottom = HEIGHT - BOTTOM;
  const x = (time: number) => LEFT + ((time - begin) / (end - begin)) * (right - LEFT);
  const y = (value: number) => bottom - upward.part(value) * (bottom - TOP);
  const ticks = spanScale([begin, end], 4).ticks.filter((time) => time >= begin && time <= end);
  root.replaceChildren(
    ...levels(upward, y),
    ...ticks.map((time) =>
      svg('text', { x: x(time), y: bottom + 16, class: 'tick tick-x' }, numeral(time)),
    ),
    svg('text', { x: (LEFT + right) / 2, y: HEIGHT - 6, class: 'axis' }, timeTitle),
    svg(
      'text',
      { x: 11, y: HEIGHT / 2, class: 'axis', transform: `rotate(-90 11 ${HEIGHT / 2})` },
      valueTitle,
    ),
    ...lines.map((line) => {
      const points = line.values.map((value, at) => [x(times[at] ?? begin), y(value)] as const);
      return svg('path', { d: pathThrough(points), class: line.class });
    }),
  );
}

/** A chart that `draw` draws anew, of at least two times. */
export function createTimePlot(className: string): {
  root: SVGElement;
  draw(chart: TimeChart): void;
} {
  const root = svg('svg', {
    viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
    class: `plot ${className}`,
    'aria-hidden': 'true',
  });
  return { root, draw: (chart) => draw(root, chart) };
}
