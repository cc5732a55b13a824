// Words and numbers on the strips, the one that is read, and how far the work is.
import { fabricNamed, fabrics, inRun } from '../../shared/fabric/fabric-data';
import { lookOf } from '../../shared/fabric/fabric-look';
import { button, element, setText } from '../../shared/panels/element';
import { addSection, noteLine } from '../../shared/panels/section';
import { heading, numberCell, tableOf } from '../../shared/panels/table-parts';
import { type Store, watch } from '../../shared/state/store';
import { OVERHANG_M } from '../state/strips';
import { type StripsState, sortedStrips } from '../state/strips-state';
import { bendingLengthWords, droopWords, markedQuantity } from './marked-words';

export interface StripsActions {
  go(): void;
  stop(): void;
  /** Shows two fabrics beside each other in motion. */
  move(fabric: string): void;
}

const CENTIMETRES = (100 * OVERHANG_M).toFixed(0);

const CAPTION = `Each strip reaches ${CENTIMETRES} cm over an edge and droops by its own weight. The stiffer and the lighter the cloth, the longer its bending length, and the less it droops.`;

const HOW =
  'Computed here, by the simulation of cloth in motion, until each strip rests. Numbers with ~ come of a rigidity or a weight that nobody measured on this very cloth. A rigidity may be off by a factor of 2, a length by a quarter: neighbours may be in another order.';

/** The one number that the picture is about, once it is known. */
export function stripsAnswer(state: Pick<StripsState, 'droops'>): string {
  const sorted = sortedStrips(state).filter((name) => state.droops[name] !== undefined);
  if (sorted.length < fabrics.length) return `${sorted.length} of ${fabrics.length} strips rest.`;
  const [first = '', last = ''] = [sorted[0], sorted.at(-1)];
  const droopOf = (name: string) => droopWords(fabricNamed(name), state.droops[name]);
  return `${first} droops least, by ${droopOf(first)}; ${last} most, by ${droopOf(last)}.`;
}

/** "canvas: ~82 µN·m hold up 290 g/m²" and what follows from that. */
export function stripReading(name: string, droop: number | undefined): string {
  const fabric = fabricNamed(name);
  const bending = markedQuantity(fabric, 'bend_warp_n_m');
  const weight = markedQuantity(fabric, 'areal_density_kg_per_m2');
  const length = bendingLengthWords(fabric);
  const droops = droop === undefined ? '' : ` It droops by ${droopWords(fabric, droop)}.`;
  return `${name}: a bending rigidity of ${bending} (${inRun(fabric, 'bend_warp_n_m').confidence}) against a weight of ${weight} makes a bending length of ${length}.${droops}`;
}

function createRow(choose: (name: string) => void) {
  const [swatch, title] = [element('span', { class: 'swatch' }), element('span')];
  let shown = '';
  const press = element('button', { type: 'button', click: () => choose(shown) }, swatch, title);
  const [length, droop] = [numberCell(), numberCell()];
  const row = element('tr', {}, element('th', { scope: 'row' }, press), length, droop);
  return {
    row,
    show(name: string, { droops, chosen }: StripsState) {
      shown = name;
      const fabric = fabricNamed(name);
      const { front, back } = lookOf(fabric.id);
      swatch.style.background = `linear-gradient(135deg, ${front} 50%, ${back} 50%)`;
      setText(title, name);
      setText(length, bendingLengthWords(fabric));
      setText(droop, droopWords(fabric, droops[name]));
      press.setAttribute('aria-pressed', String(name === chosen));
    },
  };
}

export function createStripsPanel(
  parent: HTMLElement,
  store: Store<StripsState>,
  actions: StripsActions,
): void {
  const answer = element('p', { class: 'strips-answer', role: 'status' });
  const bar = element('progress', { max: fabrics.length, 'aria-label': 'Strips at rest' });
  const stop = button('Stop', actions.stop, { class: 'wide' });
  const go = button('Let the others down', actions.go, { class: 'wide' });
  addSection(
    parent,
    'Strips',
    element('h2', {}, 'Which fabric is stiff?'),
    element('p', { class: 'caption' }, CAPTION),
    answer,
    bar,
    stop,
    go,
  );
  const rows = fabrics.map(() => createRow((chosen) => store.set({ chosen })));
  const reading = noteLine();
  const move = button('See it in motion beside another', () => actions.move(store.get().chosen), {
    class: 'wide',
  });
  addSection(
    parent,
    'Order of the strips',
    tableOf(
      'quantities strip-table',
      'Fabrics, the one that droops least first',
      heading('Fabric', 'Bending length', 'Droops by'),
      element('tbody', {}, ...rows.map(({ row }) => row)),
    ),
    reading,
    move,
    noteLine(HOW),
  );
  watch(store, ['phase', 'droops', 'chosen'], (state) => {
    const { phase, droops, chosen } = state;
    setText(answer, stripsAnswer(state));
    bar.value = Object.keys(droops).length;
    bar.hidden = phase !== 'running';
    stop.hidden = phase !== 'running';
    go.hidden = phase !== 'stopped';
    sortedStrips(state).forEach((name, index) => {
      rows[index]?.show(name, state);
    });
    setText(reading, stripReading(chosen, droops[chosen]));
  });
}
