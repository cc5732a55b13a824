// Energies over time, as lines about zero.
import { spanScale } from '../../shared/chart/linear-scale';
import { pathThrough } from '../../shared/chart/path-through';
import { svg } from '../../shared/panels/element';
import { energyUnit } from '../../shared/panels/quantity';
import type { EnergyNumbers } from '../bindings/pleat-module';
import type { EnergyLine } from './energy-lines';

const WIDTH = 360;
const HEIGHT = 230;
const LEFT = 62;
const RIGHT = 18;
const TOP = 10;
const BOTTOM = 40;
const N_LEVELS = 7;

/** A round number, with a true minus. */
function numeral(tick: number): string {
  return String(tick).replace('-', '−');
}

/** What a line looks like, in the chart and in its legend. */
export function lineClass(kind: EnergyLine['kind']): string {
  return `energy-line energy-${kind}`;
}

function draw(
  root: SVGElement,
  samples: readonly EnergyNumbers[],
  lines: readonly EnergyLine[],
): void {
  const times = samples.map(({ time_s }) => time_s);
  const [begin, end] = [times[0] ?? 0, times.at(-1) ?? 1];
  const heights = lines.map(({ joules }) => samples.map(joules));
  const all = [0, ...heights.flat()];
  const { unit, perJoule } = energyUnit(Math.max(...all.map(Math.abs)));
  const upward = spanScale(
    all.map((joules) => perJoule * joules),
    N_LEVELS,
  );
  const right = WIDTH - RIGHT;
  const bottom = HEIGHT - BOTTOM;
  const x = (time: number) => LEFT + ((time - begin) / (end - begin)) * (right - LEFT);
  const y = (value: number) => bottom - upward.part(value) * (bottom - TOP);
  const seconds = spanScale([begin, end], 4).ticks.filter((time) => time >= begin && time <= end);
  root.replaceChildren(
    ...upward.ticks.flatMap((tick) => [
      svg('line', {
        x1: LEFT,
        y1: y(tick),
        x2: right,
        y2: y(tick),
        class: tick === 0 ? 'grid' : 'grid-minor',
      }),
      svg('text', { x: LEFT - 6, y: y(tick) + 4, class: 'tick tick-y' }, numeral(tick)),
    ]),
    ...seconds.map((time) =>
      svg('text', { x: x(time), y: bottom + 16, class: 'tick tick-x' }, numeral(time)),
    ),
    svg('text', { x: (LEFT + right) / 2, y: HEIGHT - 6, class: 'axis' }, 'time [s]'),
    svg(
      'text',
      { x: 11, y: HEIGHT / 2, class: 'axis', transform: `rotate(-90 11 ${HEIGHT / 2})` },
      `energy [${unit}]`,
    ),
    ...lines.map(({ kind }, index) => {
      const joules = heights[index] ?? [];
      const points = joules.map((one, at) => [x(times[at] ?? begin), y(perJoule * one)] as const);
      return svg('path', { d: pathThrough(points), class: lineClass(kind) });
    }),
  );
}

/** A chart that `draw` draws anew, of at least two samples. */
export function createEnergyPlot(): {
  root: SVGElement;
  draw(samples: readonly EnergyNumbers[], lines: readonly EnergyLine[]): void;
} {
  const root = svg('svg', {
    viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
    class: 'plot energy-over-time',
    'aria-hidden': 'true',
  });
  return { root, draw: (samples, lines) => draw(root, samples, lines) };
}
