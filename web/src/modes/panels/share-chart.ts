// How much of a motion the first modes make up together: bars that climb to all of it.
import { element, setText, svg } from '../../shared/panels/element';
import { createPlot, levelMarks, plotText, uprightTitle } from '../../shared/panels/plot-parts';
import { percent } from '../../shared/panels/quantity';
import { addSection } from '../../shared/panels/section';
import { type Store, watch } from '../../shared/state/store';
import type { ModesState } from '../state/modes-state';

const WIDTH = 320;
const HEIGHT = 170;
const LEFT = 54;
const RIGHT = 6;
const TOP = 8;
const BOTTOM = 40;

/** More bars than this are too thin to be told apart. */
const MOST_BARS = 24;

/** The rigid motions of one body. */
const N_RIGID = 6;

export interface Shares {
  /** A motion in words: "the motion between the keys". */
  motion: string;
  /** Share of the rigid motions together; null where the body has none. */
  rigid: number | null;
  /** Shares with so many modes more, from one on. */
  modes: readonly number[];
}

/** The motion whose shares are shown. */
export function sharesOf({ drapeShares, completion, model, energy }: ModesState): Shares | null {
  if (model === 'cloth' && energy === 'cloth' && drapeShares)
    return { motion: 'the way in which the cloth drapes', rigid: null, modes: drapeShares };
  const shares = completion?.shares;
  if (!shares) return null;
  const rigid = shares[N_RIGID - 1] ?? 0;
  return {
    motion: 'the motion through the keys, in modes of the volume',
    rigid,
    modes: shares.slice(N_RIGID),
  };
}

/** A share that is called most of a motion. */
const MOST = 0.9;

/** "Of the motion ..., the first 6 modes make up 96 %." */
export function shareWords({ motion, rigid, modes }: Shares): string {
  const enough = modes.findIndex((share) => share >= MOST);
  const n = enough >= 0 ? enough + 1 : modes.length;
  const first = n === 1 ? 'the first mode' : `the first ${n} modes`;
  const alone =
    rigid === null ? `${first} alone make up` : `shifts and turns are ${percent(rigid)}, with`;
  const share = percent(modes[n - 1] ?? 0);
  const sum = rigid === null ? `${alone} ${share}` : `${alone} ${first} it is ${share}`;
  const reason =
    enough >= 0
      ? 'A few modes are enough to work with.'
      : 'Large turns are missing: a mode moves every point straight.';
  return `Of ${motion}, ${sum}. ${reason}`;
}

function draw(root: SVGElement, { rigid, modes }: Shares): void {
  const bars = [...(rigid === null ? [] : [rigid]), ...modes.slice(0, MOST_BARS)];
  const first = rigid === null ? 1 : 0;
  const width = (WIDTH - LEFT - RIGHT) / bars.length;
  const y = (share: number) => HEIGHT - BOTTOM - share * (HEIGHT - TOP - BOTTOM);
  const parts: SVGElement[] = [];
  for (const tick of [0, 0.25, 0.5, 0.75, 1])
    parts.push(...levelMarks([LEFT, WIDTH - RIGHT], y(tick), String(100 * tick), 5));
  const stride = Math.ceil(bars.length / 7);
  bars.forEach((share, index) => {
    const x = LEFT + index * width;
    const kind = first + index === 0 ? 'bar bar-rigid' : 'bar';
    const bar = svg('rect', {
      x: x + 0.1 * width,
      y: y(share),
      width: 0.8 * width,
      height: HEIGHT - BOTTOM - y(share),
      class: kind,
    });
    parts.push(bar);
    if (index % stride === 0)
      parts.push(
        plotText('tick tick-x', x + width / 2, HEIGHT - BOTTOM + 14, String(first + index)),
      );
  });
  const title = rigid === null ? 'first modes' : 'rigid motions (0) and first modes';
  parts.push(
    plotText('axis', LEFT + (WIDTH - LEFT) / 2, HEIGHT - 4, title),
    uprightTitle(13, HEIGHT / 2 - 12, '% of the motion'),
  );
  root.replaceChildren(...parts);
}

export function createShareChart(parent: HTMLElement, store: Store<ModesState>): void {
  const root = createPlot(WIDTH, HEIGHT);
  const words = element('figcaption');
  const figure = element('figure', { class: 'chart' });
  figure.append(root, words);
  addSection(
    parent,
    'How much is in the first modes',
    element('h2', {}, 'How much is in the first modes?'),
    figure,
  );
  const keys: (keyof ModesState)[] = ['drapeShares', 'completion', 'model', 'energy'];
  watch(store, keys, (state) => {
    const shares = sharesOf(state);
    root.toggleAttribute('hidden', shares === null);
    if (shares) draw(root, shares);
    setText(
      words,
      shares ? shareWords(shares) : 'It is known of surfaces in one part, once there are keys.',
    );
  });
}
