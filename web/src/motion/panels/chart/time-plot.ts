// Quantities over time, as lines.
import '../../../shared/page/energies.css';
import './time-plot.css';
import { spanScale } from '../../../shared/chart/linear-scale';
import { pathThrough } from '../../../shared/chart/path-through';
import { svg } from '../../../shared/panels/element';
import { createPlot, levelMarks, plotText, uprightTitle } from '../../../shared/panels/plot-parts';

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
    ...upward.ticks.flatMap((tick) =>
      levelMarks([LEFT, right], y(tick), numeral(tick), 6, tick === 0 ? 'grid' : 'grid-minor'),
    ),
    ...ticks.map((time) => plotText('tick tick-x', x(time), bottom + 16, numeral(time))),
    plotText('axis', (LEFT + right) / 2, HEIGHT - 6, timeTitle),
    uprightTitle(11, HEIGHT / 2, valueTitle),
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
  const root = createPlot(WIDTH, HEIGHT, className);
  return { root, draw: (chart) => draw(root, chart) };
}
