// The scene and the two fabrics that move in it, their numbers, and how far apart they are.
import { type FabricQuantity, fabricNamed, fabrics } from '../../shared/fabric/fabric-data';
import { choice, element, field, setText } from '../../shared/panels/element';
import { digits } from '../../shared/panels/quantity';
import { createRunTools, type Playable } from '../../shared/panels/run-tools';
import { addSection, noteLine } from '../../shared/panels/section';
import { heading, numberCell, rowOf, tableOf } from '../../shared/panels/table-parts';
import { type Store, watch } from '../../shared/state/store';
import { PAIR_SCENE_IDS, PAIR_SCENES, type Pair, type PairState } from '../state/pair';
import { bendingLengthWords, markedQuantity } from './marked-words';

const ROWS: readonly [string, FabricQuantity][] = [
  ['Weight', 'areal_density_kg_per_m2'],
  ['Bending', 'bend_warp_n_m'],
  ['Stretch', 'stretch_warp_n_per_m'],
];

/** "They are up to 5.1 cm apart." */
export function apartWords({ apartM, pair, timeS }: PairState): string {
  const [a, b] = pair;
  if (timeS === 0) return 'Both begin alike. Press Play, or pull: the hand has both.';
  if (a === b) return 'Both are the same fabric, and move alike.';
  const length = apartM < 0.01 ? `${digits(1000 * apartM, 2)} mm` : `${digits(100 * apartM, 2)} cm`;
  return `By now the same place on ${a} and on ${b} is up to ${length} apart.`;
}

function numberRows(pair: Pair): HTMLElement[] {
  const records = pair.map(fabricNamed);
  const rows = ROWS.map(([title, key]) =>
    rowOf(title, ...records.map((fabric) => numberCell(markedQuantity(fabric, key)))),
  );
  const lengths = records.map((fabric) => numberCell(bendingLengthWords(fabric)));
  return [...rows, rowOf('Bending length', ...lengths)];
}

export function createPairPanel(parent: HTMLElement, store: Store<PairState>): void {
  const scene = choice(
    PAIR_SCENE_IDS.map((value) => ({ value, title: PAIR_SCENES[value].title })),
    (value) => store.set({ scene: value }),
  );
  const names = fabrics.map(({ name_en: value }) => ({ value, title: value }));
  const first = choice(names, (name) => store.set({ pair: [name, store.get().pair[1]] }));
  const second = choice(names, (name) => store.set({ pair: [store.get().pair[0], name] }));
  const caption = element('p', { class: 'caption' });
  const apart = element('p', { class: 'strips-answer' });
  addSection(
    parent,
    'What moves',
    element('h2', {}, 'Two fabrics, one motion'),
    field('Scene', scene.control),
    element('div', { class: 'pair' }, field('Left', first.control), field('Right', second.control)),
    caption,
    apart,
  );
  const box = element('div');
  addSection(
    parent,
    'Numbers of both',
    box,
    noteLine(
      'Along the warp. Bending is at rest, with the friction between yarns: the number that this run takes. Numbers with ~ nobody measured on this very cloth.',
    ),
  );
  watch(store, ['scene', 'pair'], ({ scene: now, pair }) => {
    scene.select(now);
    first.select(pair[0]);
    second.select(pair[1]);
    setText(caption, PAIR_SCENES[now].caption);
    const body = element('tbody', {}, ...numberRows(pair));
    box.replaceChildren(
      tableOf('quantities', 'Numbers of both fabrics', heading('', ...pair), body),
    );
  });
  watch(store, ['apartM', 'pair', 'timeS'], (state) => setText(apart, apartWords(state)));
}

const WORDS = {
  step: 'One step of 1/60 s of both (full stop)',
  reset: 'Both from the beginning (R)',
  view: 'Look from the first direction (Home)',
  speed: 'simulated seconds a second, if the device keeps up',
};

export function createPairTools(
  parent: HTMLElement,
  store: Store<PairState>,
  run: Playable,
  homeView: () => void,
): void {
  const canReset = (phase: string) => phase === 'ready' || phase === 'stopped';
  createRunTools(parent, store, run, homeView, WORDS, canReset);
  const time = element('output', { class: 'toolbar-time', 'aria-live': 'off' });
  parent.append(time);
  watch(store, ['timeS'], ({ timeS }) => setText(time, `${timeS.toFixed(2)} s`));
}

/** Names above the panes. */
export function createPairBadges(parent: HTMLElement, store: Store<PairState>) {
  const grid = element('div', { class: 'panes' });
  parent.append(grid);
  const badges = [0, 1].map(() => {
    const [name, length] = [element('b'), element('span')];
    const badge = element('p', { class: 'pane-badge pair-badge' }, name, length);
    grid.append(element('div', { class: 'pane' }, badge));
    return { name, length };
  });
  watch(store, ['pair'], ({ pair }) => {
    pair.forEach((fabric, pane) => {
      const badge = badges[pane];
      if (!badge) return;
      setText(badge.name, fabric);
      setText(badge.length, `bending length ${bendingLengthWords(fabricNamed(fabric))}`);
    });
  });
  return { setColumns: (n: number) => grid.style.setProperty('--columns', String(n)) };
}
