// Badges of what each pane shows: fabric, energy, time; a press on it chooses the pane.

import { fabricNamed } from '../../shared/fabric/fabric-data';
import { button, element, setText } from '../../shared/panels/element';
import { digits, milliseconds } from '../../shared/panels/quantity';
import { type Store, watch } from '../../shared/state/store';
import { titleOf } from '../state/fabric-choice';
import type { FabricOrder } from '../state/fabric-order';
import type { FabricsState } from '../state/fabrics-state';
import { orderedQuantity } from './fabric-gallery';

type Pane = FabricsState['panes'][number];

function timeWords({ status, updateMs }: Pane, isLoading: boolean): string {
  if (isLoading) return 'opening';
  const time = Number.isFinite(updateMs) ? milliseconds(updateMs) : '';
  if (status === 'dragging') return `${time} an update`;
  if (status === 'settling') return 'settling';
  return status === 'converged' ? `found in ${time}` : `not quite found in ${time}`;
}

const ENERGY_MEANING =
  'What the shape costs by the weights of this fabric: a number without unit, to be compared with other shapes of the same fabric only';

const QUANTITY_MEANING =
  'What the fabrics are ordered by; the shape is of the weights and does not show it';

/** The number that the list is ordered by, or the energy, with its name. */
export function paneNumber(
  { fabric, energy }: Pick<Pane, 'fabric' | 'energy'>,
  order: FabricOrder,
): { words: string; meaning: string } {
  if (order === 'source' || fabric.kind === 'own')
    return { words: `energy ${digits(energy)}`, meaning: ENERGY_MEANING };
  return { words: orderedQuantity(fabricNamed(fabric.name), order), meaning: QUANTITY_MEANING };
}

function createBadge(choose: () => void) {
  const name = element('b');
  const number = element('span');
  const time = element('span');
  const badge = button(name, choose, { class: 'pane-badge' });
  badge.append(number, time);
  return {
    cell: element('div', { class: 'pane' }, badge),
    show(pane: Pane, isChosen: boolean, { panes, phase, order }: FabricsState) {
      const isBrief = panes.length > 4;
      const isLoading = phase === 'loading';
      setText(name, titleOf(pane.fabric));
      const { words, meaning } = paneNumber(pane, isBrief ? order : 'source');
      setText(number, words);
      number.title = meaning;
      setText(time, timeWords(pane, isLoading));
      badge.classList.toggle('brief', isBrief);
      time.hidden = isBrief && !isLoading && pane.status !== 'settling';
      badge.setAttribute('aria-pressed', String(isChosen));
    },
  };
}

/** How many panes stand side by side, for a stage of that shape. */
export function columnsFor(nPanes: number, width: number, height: number): number {
  const isWide = width > height;
  if (nPanes > 4) return isWide ? 5 : 3;
  if (nPanes === 4) return 2;
  return isWide ? nPanes : 1;
}

export function createPaneBadges(
  parent: HTMLElement,
  store: Store<FabricsState>,
  actions: { choose(pane: number): void },
): { setColumns(nColumns: number): void } {
  const grid = element('div', { class: 'panes' });
  parent.append(grid);
  let badges: ReturnType<typeof createBadge>[] = [];
  watch(store, ['panes', 'chosen', 'phase', 'order'], (state) => {
    const { panes, chosen } = state;
    if (badges.length !== panes.length) {
      badges = panes.map((_, index) => createBadge(() => actions.choose(index)));
      grid.replaceChildren(...badges.map(({ cell }) => cell));
    }
    panes.forEach((pane, index) => {
      badges[index]?.show(pane, index === chosen, state);
    });
  });
  return { setColumns: (nColumns) => grid.style.setProperty('--columns', String(nColumns)) };
}
