// Volume and energy along the timeline, of the in-betweens and of the straight way.
import { linearScale } from '../../shared/chart/linear-scale';
import { pathThrough } from '../../shared/chart/path-through';
import { element, setText, svg } from '../../shared/panels/element';
import { lineKey } from '../../shared/panels/line-key';
import { createPlot, levelMarks, plotText } from '../../shared/panels/plot-parts';
import { noteLine } from '../../shared/panels/section';
import { type Store, watch } from '../../shared/state/store';
import type { FilledFrame } from '../bindings/modal-module';
import { energyOf } from '../state/material';
import { type Completion, isSolid, type ModesState } from '../state/modes-state';
import { createCompletionTable } from './completion-table';
import { halvesWords, storyWords } from './completion-words';

const WIDTH = 400;
const HEIGHT = 104;
const LEFT = 52;
const RIGHT = 8;
const TOP = 8;
const BOTTOM = 30;

/** One of the two charts: a number of the in-betweens and the same of the straight way. */
interface Curve {
  title: string;
  /** It begins at zero. */
  fromZero: boolean;
  ours(frame: FilledFrame, rest_m3: number): number;
  straight(frame: FilledFrame, rest_m3: number): number;
}

const VOLUME: Curve = {
  title: 'Volume [% of the first key’s]',
  fromZero: false,
  ours: ({ volume_m3 }, rest) => (100 * volume_m3) / rest,
  straight: ({ straight_volume_m3 }, rest) => (100 * straight_volume_m3) / rest,
};

const SHELL_VOLUME: Curve = { ...VOLUME, title: 'Volume of the shell [% of the first key’s]' };

const ENERGY: Curve = {
  title: 'Energy, of soft rubber [J]',
  fromZero: true,
  ours: ({ strain }, rest) => energyOf(strain, rest),
  straight: ({ straight_strain }, rest) => energyOf(straight_strain, rest),
};

/** Strain in place of joules: where the thickness is made up, joules would be too. */
const STRAIN: Curve = {
  title: 'Root of the energy, as mean strain [%]',
  fromZero: true,
  ours: ({ strain }) => 100 * strain,
  straight: ({ straight_strain }) => 100 * straight_strain,
};

/** Room below and above for what hardly changes [%]. */
const LEAST_SPAN = 0.1;

/** The ends of an axis and the values written on it. */
function axisFor(values: readonly number[], fromZero: boolean) {
  const most = Math.max(...values);
  const least = fromZero ? 0 : Math.min(...values);
  const span = Math.max(most - least, LEAST_SPAN * (fromZero ? 1e-6 : 10));
  const { ticks } = linearScale([span], 3);
  const step = (ticks[1] ?? span) - (ticks[0] ?? 0);
  const low = fromZero ? 0 : Math.floor(least / step) * step;
  const high = low + Math.ceil((most - low) / step - 1e-9) * step || low + step;
  const n = Math.max(1, Math.round((high - low) / step));
  return {
    part: (value: number) => (value - low) / (n * step),
    ticks: Array.from({ length: n + 1 }, (_, index) => low + index * step),
  };
}

interface Drawn {
  root: SVGElement;
  now: SVGElement;
  x(time: number): number;
}

function draw(curve: Curve, frames: readonly FilledFrame[]): Drawn {
  const rest = frames[0]?.volume_m3 ?? 1;
  const ours = frames.map((frame) => curve.ours(frame, rest));
  const straight = frames.map((frame) => curve.straight(frame, rest));
  const axis = axisFor([...ours, ...straight], curve.fromZero);
  const end = frames.at(-1)?.time ?? 1;
  const x = (time: number) => LEFT + (time / end) * (WIDTH - LEFT - RIGHT);
  const y = (value: number) => HEIGHT - BOTTOM - axis.part(value) * (HEIGHT - TOP - BOTTOM);
  const root = createPlot(WIDTH, HEIGHT);
  for (const tick of axis.ticks)
    root.append(
      ...levelMarks([LEFT, WIDTH - RIGHT], y(tick), String(Number(tick.toPrecision(3))), 5),
    );
  for (let key = 0; key <= end; ++key)
    root.append(
      svg('line', { x1: x(key), y1: TOP, x2: x(key), y2: HEIGHT - BOTTOM, class: 'grid-minor' }),
      plotText('tick tick-x', x(key), HEIGHT - BOTTOM + 15, String(key + 1)),
    );
  const points = (values: readonly number[]) =>
    values.map((value, index) => [x(frames[index]?.time ?? 0), y(value)] as const);
  const now = svg('line', { y1: TOP, y2: HEIGHT - BOTTOM, class: 'now' });
  root.append(
    svg('path', { d: pathThrough(points(straight)), class: 'curve-straight' }),
    svg('path', { d: pathThrough(points(ours)), class: 'curve-ours' }),
    now,
    plotText('axis', LEFT + (WIDTH - LEFT) / 2, HEIGHT - 3, 'key'),
  );
  return { root, now, x };
}

/** The two charts, and lines on them at the present time. */
function createCharts() {
  const boxes = [0, 1].map(() => {
    const title = element('figcaption');
    const place = element('div');
    return { figure: element('figure', { class: 'curve-box' }, title, place), title, place };
  });
  let drawn: Drawn[] = [];
  return {
    box: element('div', { class: 'curves' }, ...boxes.map(({ figure }) => figure)),
    show(frames: readonly FilledFrame[], isOfRubber: boolean) {
      const curves = isOfRubber ? [VOLUME, ENERGY] : [SHELL_VOLUME, STRAIN];
      drawn = curves.map((curve) => draw(curve, frames));
      boxes.forEach(({ title, place }, index) => {
        setText(title, curves[index]?.title ?? '');
        place.replaceChildren(...(drawn[index] ? [drawn[index].root] : []));
      });
    },
    setTime(time: number) {
      for (const { now, x } of drawn)
        for (const end of ['x1', 'x2']) now.setAttribute(end, String(x(time)));
    },
  };
}

export function createCompletionCurves(parent: HTMLElement, store: Store<ModesState>): void {
  const charts = createCharts();
  const legend = element(
    'ul',
    { class: 'marks line-keys' },
    lineKey('curve-ours', 'In-betweens'),
    lineKey('curve-straight', 'Straight from key to key, the ghost'),
  );
  const story = element('p', { class: 'story' });
  const halves = noteLine();
  const table = createCompletionTable();
  const whole = element('div', {}, story, legend, charts.box, halves, table.box);
  parent.append(whole);
  let shown: Completion | null = null;
  watch(store, ['completion', 'keys', 'phase', 'working', 'showing'], (state) => {
    const { completion, showing } = state;
    whole.hidden = showing === 'modes';
    for (const part of [charts.box, legend, halves, table.box]) part.hidden = completion === null;
    setText(story, storyWords(state));
    if (!completion || completion === shown) return;
    shown = completion;
    charts.show(completion.frames, isSolid(state));
    table.show(completion.frames);
    setText(halves, halvesWords(completion));
  });
  watch(store, ['time', 'completion'], ({ time }) => charts.setTime(time));
}
