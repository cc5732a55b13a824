// The axes of a chart with logarithms both ways.
import { type LogScale, logScale } from '../../../shared/chart/log-scale';
import { svg } from '../../../shared/panels/element';
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
  const level = (value: number, kind: string) =>
    svg('line', { x1: left, y1: yOf(value), x2: right, y2: yOf(value), class: kind });
  const tick = (x: number, y: number, kind: string, value: number) =>
    svg('text', { x, y, class: `tick ${kind}` }, digits(value, 1));
  return [
    ...across.minorTicks.map((value) => upright(value, 'grid-minor')),
    ...upward.minorTicks.map((value) => level(value, 'grid-minor')),
    ...across.ticks.flatMap((value) => [
      upright(value, 'grid'),
      tick(xOf(value), bottom + 17, 'tick-x', value),
    ]),
    ...upward.ticks.flatMap((value) => [
      level(value, 'grid'),
      tick(left - 8, yOf(value) + 4, 'tick-y', value),
    ]),
  ];
}

/** Titles below the field and, upright, beside it. */
export function axisTitles(
  { left, right, top, bottom }: Field,
  x: string,
  y: string,
): SVGElement[] {
  const middle = (top + bottom) / 2;
  const turned = { x: 14, y: middle, transform: `rotate(-90 14 ${middle})` };
  return [
    svg('text', { x: (left + right) / 2, y: bottom + 38, class: 'axis' }, x),
    svg('text', { ...turned, class: 'axis' }, y),
  ];
}
