// The axes of a chart with logarithms both ways.
import { type LogScale, logScale } from '../../../shared/chart/log-scale';
import { svg } from '../../../shared/panels/element';
import { levelMarks, plotText, uprightTitle } from '../../../shared/panels/plot-parts';
import { digits } from '../../../shared/panels/quantity';

/** The sides of the field between the axes, in the units of the drawing. */
export interface Field {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

/** Axes that place numbers in the chart. */
export interface Axes {
  field: Field;
  across: LogScale;
  upward: LogScale;
  xOf(value: number): number;
  yOf(value: number): number;
}

/** Axes that reach over all these numbers; `few` as logScale has it. */
export function logAxes(
  field: Field,
  xs: readonly number[],
  ys: readonly number[],
  few?: number,
): Axes {
  const { left, right, top, bottom } = field;
  const across = logScale(xs, few);
  const upward = logScale(ys, few);
  return {
    field,
    across,
    upward,
    xOf: (value) => left + across.part(value) * (right - left),
    yOf: (value) => bottom - upward.part(value) * (bottom - top),
  };
}

export function gridMarks({ field, across, upward, xOf, yOf }: Axes): SVGElement[] {
  const { left, right, top, bottom } = field;
  const upright = (value: number, kind: string) =>
    svg('line', { x1: xOf(value), y1: top, x2: xOf(value), y2: bottom, class: kind });
  return [
    ...across.minorTicks.map((value) => upright(value, 'grid-minor')),
    ...upward.minorTicks.map((value) =>
      svg('line', { x1: left, y1: yOf(value), x2: right, y2: yOf(value), class: 'grid-minor' }),
    ),
    ...across.ticks.flatMap((value) => [
      upright(value, 'grid'),
      plotText('tick tick-x', xOf(value), bottom + 17, digits(value, 1)),
    ]),
    ...upward.ticks.flatMap((value) =>
      levelMarks([left, right], yOf(value), digits(value, 1), 8, 'grid'),
    ),
  ];
}

/** Titles below the field and, upright, beside it. */
export function axisTitles(
  { left, right, top, bottom }: Field,
  x: string,
  y: string,
): SVGElement[] {
  return [
    plotText('axis', (left + right) / 2, bottom + 38, x),
    uprightTitle(14, (top + bottom) / 2, y),
  ];
}
