// All fabrics as a list: one is shown in the chosen pane, up to four stand side by side.
import { type FabricRecord, fabricNamed, fabrics } from '../../shared/fabric/fabric-data';
import { lookOf } from '../../shared/fabric/fabric-look';
import {
  button as buttonOf,
  choice as choiceOf,
  element,
  field,
  setText,
} from '../../shared/panels/element';
import { addSection, noteLine } from '../../shared/panels/section';
import { type Store, watch } from '../../shared/state/store';
import { type DeformState, type FabricChoice, TERMS } from '../state/deform-state';
import { type Comparison, isSame, titleOf, withShown, withToggled } from '../state/fabric-choice';
import { geometryOf } from '../state/fabric-geometry';
import { type FabricOrder, orderedFabrics, quantityOf } from '../state/fabric-order';
import { markedQuantity } from './marked-words';
import { TERM_TITLES } from './term-words';
import { createWeightBar, termKey, weightWords } from './weight-bar';

export interface GalleryActions {
  /** Shows these fabrics side by side. */
  compare(comparison: Comparison): void;
  /** Another pane's card and numbers. */
  choose(pane: number): void;
  /** All fifteen at once, or those compared before. */
  showAll(all: boolean): void;
  setOrder(order: FabricOrder): void;
}

const ORDER_TITLES: readonly { value: FabricOrder; title: string }[] = [
  { value: 'source', title: 'As in the source, with weights' },
  { value: 'bending', title: 'Stiffest to bend first' },
  { value: 'weight', title: 'Heaviest first' },
  { value: 'stretch', title: 'Hardest to stretch first' },
];

const MEANINGS: Record<Exclude<FabricOrder, 'source'>, string> = {
  bending: 'bending rigidity at rest along the warp, for a metre of width',
  weight: 'mass of one square metre',
  stretch: 'the force along the warp that would double the length, for a metre of width',
};

/** The state by which the panes are filled and the list is ordered. */
export function orderNote(order: FabricOrder): string {
  if (order === 'source')
    return 'The bars are weights measured in 2015, and the panes show shapes by them: what gives way first inside one fabric. They do not say which of two fabrics is stiffer. Choose another order for that.';
  return `Ordered by ${MEANINGS[order]}. Numbers marked ~ may be off by a factor of 2: neighbours among them may be in another order. The panes show something else: shapes by weights measured in 2015, which do not say which of two fabrics is stiffer.`;
}

/** The number that fabrics are ordered by; empty where that is none. */
export function orderedQuantity(fabric: FabricRecord, order: FabricOrder): string {
  const key = quantityOf(order);
  return key === null ? '' : markedQuantity(fabric, key);
}

/** Cell of the list: the fabric's button in column 0, its check box in column 1. */
export interface Cell {
  row: number;
  column: number;
}

/** Cell that a key leads to; null for a key that leads nowhere. */
export function cellAfter(key: string, { row, column }: Cell, nRows: number): Cell | null {
  const last = nRows - 1;
  switch (key) {
    case 'ArrowDown':
      return { row: Math.min(last, row + 1), column };
    case 'ArrowUp':
      return { row: Math.max(0, row - 1), column };
    case 'ArrowRight':
      return { row, column: 1 };
    case 'ArrowLeft':
      return { row, column: 0 };
    case 'Home':
      return { row: 0, column };
    case 'End':
      return { row: last, column };
    default:
      return null;
  }
}

function createRow({ id, name_en: name }: FabricRecord, press: () => void, toggle: () => void) {
  const { front, back } = lookOf(id);
  const swatch = element('span', { class: 'swatch', 'aria-hidden': 'true' });
  swatch.style.background = `linear-gradient(135deg, ${front} 50%, ${back} 50%)`;
  const { bar, show: showWeights } = createWeightBar();
  const words = element('span', { class: 'unseen' });
  const quantity = element('span', { class: 'fabric-quantity' });
  const button = element(
    'button',
    { type: 'button', tabindex: -1, click: press },
    swatch,
    element('span', { class: 'fabric-name' }, name),
    words,
    bar,
    quantity,
  );
  const box = element('input', {
    type: 'checkbox',
    tabindex: -1,
    'aria-label': `Compare ${name}`,
    title: 'Show it beside the others',
    change: toggle,
  });
  const boxCell = element('span', { role: 'gridcell' }, box);
  const row = element(
    'div',
    { role: 'row', class: 'fabric-row' },
    element('span', { role: 'gridcell' }, button),
    boxCell,
  );
  return { name, row, button, box, boxCell, words, bar, quantity, showWeights };
}

type Row = ReturnType<typeof createRow>;

/** The rows as one stop for Tab; arrow keys lead on from it. */
function createGrid(all: readonly Row[]) {
  let rows = all;
  let current: Cell = { row: 0, column: 0 };

  function controlAt({ row, column }: Cell): HTMLElement | null {
    const found = rows[row];
    if (!found) return null;
    return column === 1 && !found.boxCell.hidden ? found.box : found.button;
  }

  function moveTo(cell: Cell): void {
    controlAt(current)?.setAttribute('tabindex', '-1');
    current = cell;
    controlAt(current)?.setAttribute('tabindex', '0');
  }

  const grid = element(
    'div',
    {
      role: 'grid',
      class: 'fabric-list',
      'aria-label': 'Fabrics',
      keydown(event) {
        if (!(event instanceof KeyboardEvent)) return;
        const next = cellAfter(event.key, current, rows.length);
        if (!next) return;
        event.preventDefault();
        moveTo(next);
        controlAt(next)?.focus();
      },
      focusin({ target }) {
        const row = rows.findIndex(
          ({ row: one }) => target instanceof Node && one.contains(target),
        );
        if (row >= 0) moveTo({ row, column: rows[row]?.box === target ? 1 : 0 });
      },
    },
    ...rows.map(({ row }) => row),
  );
  moveTo(current);
  return {
    grid,
    order(names: readonly string[]) {
      controlAt(current)?.setAttribute('tabindex', '-1');
      rows = names.flatMap((name) => all.find((row) => row.name === name) ?? []);
      grid.replaceChildren(...rows.map(({ row }) => row));
      moveTo({ row: 0, column: 0 });
    },
    /** The check boxes are gone. */
    leaveBoxes() {
      if (current.column === 1) moveTo({ row: current.row, column: 0 });
    },
  };
}

/** Shows in each row what is shown in panes, and the weights or what the list is ordered by. */
function renderRows(rows: readonly Row[], state: DeformState): void {
  const { panes, chosen, gallery, weightsFrom, order } = state;
  const shown = panes.map(({ fabric }) => titleOf(fabric));
  for (const { name, button, box, boxCell, words, bar, quantity, showWeights } of rows) {
    const fabric = fabricNamed(name);
    const weights = geometryOf(fabric)[weightsFrom];
    showWeights(weights);
    bar.hidden = order !== 'source';
    quantity.hidden = order === 'source';
    setText(quantity, orderedQuantity(fabric, order));
    setText(words, order === 'source' ? `: ${weightWords(weights)}` : '');
    button.setAttribute('aria-pressed', String(shown[chosen] === name));
    box.checked = shown.includes(name);
    boxCell.hidden = gallery;
  }
}

/** Presses on a fabric and ticks at it; `onRefused` hears why nothing was done. */
function createChoices(
  store: Store<DeformState>,
  actions: GalleryActions,
  onRefused: (sentence: string) => void,
) {
  function comparison(): Comparison {
    const { panes, chosen } = store.get();
    return { fabrics: panes.map((pane) => pane.fabric), chosen };
  }
  return {
    press(choice: FabricChoice): void {
      const { panes, gallery } = store.get();
      const pane = panes.findIndex(({ fabric }) => isSame(fabric, choice));
      if (pane >= 0) actions.choose(pane);
      else if (!gallery) actions.compare(withShown(comparison(), choice));
    },
    toggle(choice: FabricChoice): void {
      const changed = withToggled(comparison(), choice);
      if (typeof changed === 'string') return onRefused(changed);
      onRefused('');
      actions.compare(changed);
    },
  };
}

export function createFabricGallery(
  parent: HTMLElement,
  store: Store<DeformState>,
  actions: GalleryActions,
): void {
  const { press, toggle } = createChoices(store, actions, (sentence) => {
    setText(refusal, sentence);
    if (sentence !== '') render();
  });
  const rows = fabrics.map((fabric) => {
    const choice: FabricChoice = { kind: 'named', name: fabric.name_en };
    const pressRow = () => press(choice);
    return createRow(fabric, pressRow, () => toggle(choice));
  });
  const { grid, leaveBoxes, order: orderRows } = createGrid(rows);
  const order = choiceOf(ORDER_TITLES, actions.setOrder);
  const orderWords = noteLine();
  const legend = element(
    'ul',
    { class: 'marks', 'aria-label': 'Bars' },
    ...TERMS.map((term) => element('li', {}, termKey(term), TERM_TITLES[term])),
  );
  const all = buttonOf('All fifteen at once', () => actions.showAll(!store.get().gallery), {
    class: 'wide',
  });
  const hint = noteLine();
  const refusal = element('p', { class: 'note', role: 'status' });
  addSection(
    parent,
    'Choice of fabrics',
    all,
    hint,
    field('Order', order.control),
    orderWords,
    legend,
    grid,
    refusal,
  );

  let ordered: FabricOrder = 'source';
  function render(): void {
    const state = store.get();
    if (state.order !== ordered) orderRows(orderedFabrics(state.order).map((one) => one.name_en));
    ordered = state.order;
    order.select(state.order);
    setText(orderWords, orderNote(state.order));
    legend.hidden = state.order !== 'source';
    all.setAttribute('aria-pressed', String(state.gallery));
    setText(
      hint,
      state.gallery
        ? 'Choose a fabric to read its card.'
        : 'Choose a fabric for the pane; tick up to four to see them side by side.',
    );
    renderRows(rows, state);
    if (state.gallery) leaveBoxes();
  }

  // Numbers of a pane change with every frame of a drag, this list does not.
  let drawn = '';
  watch(store, ['panes', 'chosen', 'gallery', 'weightsFrom', 'order'], (state) => {
    const { panes, chosen, gallery, weightsFrom } = state;
    const names = panes.map(({ fabric }) => titleOf(fabric));
    const text = JSON.stringify([names, chosen, gallery, weightsFrom, state.order]);
    if (text === drawn) return;
    drawn = text;
    setText(refusal, '');
    render();
  });
}
