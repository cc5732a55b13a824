// Plot of what each method leaves of a step's error, over the time that it takes.
import './convergence.css';
import { pathThrough } from '../../../shared/chart/path-through';
import { element, setText, svg } from '../../../shared/panels/element';
import { axisTitles, gridMarks, logAxes } from '../chart/log-plot';
import { legendItem, markOf } from '../chart/stepper-mark';
import { pointWords, type Way } from './convergence-words';

const WIDTH = 360;
const HEIGHT = 280;
const FIELD = { left: 66, right: WIDTH - 10, top: 10, bottom: HEIGHT - 46 };

/** Less than this is drawn as if it were so much. */
const LEAST_LEFT = 1e-4;

/** There is little room for labels between decades. */
const FEW_DECADES = 1.7;

const HIT_RADIUS = 9;
const SHOW = 'Point at a mark, or tap it, to read its values; arrow keys go along.';

function lineKind({ isOwn }: Way): string {
  return isOwn ? 'way way-own' : 'way';
}

function legendOf(ways: readonly Way[]): HTMLElement[] {
  return ways.map((way) => {
    const { path, style } = markOf(way.stepper);
    return legendItem({ [lineKind(way)]: 'M-8 0H8', 'point-mark': path }, way.title, style);
  });
}

/** Arrow keys go from mark to mark of a way: each way is one stop of the tabulator. */
function goAlong(event: Event): void {
  if (!(event instanceof KeyboardEvent) || !(event.target instanceof Element)) return;
  const { target, key } = event;
  const next =
    key === 'ArrowRight'
      ? target.nextElementSibling
      : key === 'ArrowLeft' && target.previousElementSibling;
  if (!(next instanceof SVGElement) || !next.hasAttribute('tabindex')) return;
  event.preventDefault();
  next.focus();
}

/** A chart with its legend and a line that tells the values of a mark; `draw` draws it anew. */
export function createConvergencePlot(parent: HTMLElement): {
  draw(ways: readonly Way[], valueTitle: string): void;
} {
  const root = svg('svg', {
    viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
    class: 'plot convergence-plot',
    role: 'group',
    'aria-label': 'What each method leaves over the milliseconds that it takes',
  });
  const legend = element('ul', { class: 'marks' });
  const values = element('p', { class: 'note way-values' }, SHOW);
  parent.append(legend, root, values);

  function marksOf(
    way: Way,
    xOf: (ms: number) => number,
    yOf: (left: number) => number,
  ): SVGElement {
    const { path, style } = markOf(way.stepper);
    const group = svg('g', { style, 'data-title': way.title });
    const places = way.points.map(
      ({ ms, left }) => [xOf(ms), yOf(Math.max(left, LEAST_LEFT))] as const,
    );
    group.append(svg('path', { d: pathThrough(places), class: lineKind(way) }));
    way.points.forEach((point, index) => {
      const [x, y] = places[index] ?? [0, 0];
      const label = pointWords(way, point);
      const mark = svg('g', {
        transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})`,
        class: 'way-point',
        role: 'img',
        tabindex: index === 0 ? 0 : -1,
        'aria-label': label,
      });
      mark.append(
        svg('title', {}, label),
        svg('circle', { r: HIT_RADIUS, class: 'point-hit' }),
        svg('path', { d: path, class: 'point-mark' }),
      );
      for (const heard of ['pointerenter', 'focus'])
        mark.addEventListener(heard, () => setText(values, `${label}.`));
      group.append(mark);
    });
    return group;
  }
  root.addEventListener('keydown', goAlong);

  return {
    draw(ways, valueTitle) {
      const points = ways.flatMap((way) => way.points);
      const lefts = points.map(({ left }) => Math.max(left, LEAST_LEFT));
      const axes = logAxes(
        FIELD,
        points.map(({ ms }) => ms),
        lefts,
        FEW_DECADES,
      );
      legend.replaceChildren(...legendOf(ways));
      setText(values, SHOW);
      root.replaceChildren(
        ...gridMarks(axes),
        ...axisTitles(FIELD, 'ms of this step', valueTitle),
        ...ways.map((way) => marksOf(way, axes.xOf, axes.yOf)),
      );
    },
  };
}
