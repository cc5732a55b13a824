// What each pane shows: fabric, energy, time; a press on it chooses the pane.
import { element, setText } from '../../shared/panels/element';
import { digits, milliseconds } from '../../shared/panels/quantity';
import { type Store, watch } from '../../shared/state/store';
import { titleOf } from '../state/fabric-choice';
import type { FabricsState } from '../state/fabrics-state';

type Pane = FabricsState['panes'][number];

function timeWords({ status, updateMs }: Pane, isLoading: boolean): string {
  if (isLoading) return 'opening';
  const time = Number.isFinite(updateMs) ? milliseconds(updateMs) : '';
  if (status === 'dragging') return `${time} an update`;
  if (status === 'settling') return 'settling';
  return status === 'converged' ? `found in ${time}` : `not quite found in ${time}`;
}

function createBadge(choose: () => void) {
  const name = element('b');
  const energy = element('span');
  const time = element('span');
  const button = element('button', { type: 'button', class: 'pane-badge', click: choose }, name);
  button.append(energy, time);
  return {
    cell: element('div', { class: 'pane' }, button),
    show(pane: Pane, isChosen: boolean, isBrief: boolean, isLoading: boolean) {
      setText(name, titleOf(pane.fabric));
      setText(energy, `E ${digits(pane.energy)}`);
      energy.title = 'Energy of the shape: a number without unit';
      setText(time, timeWords(pane, isLoading));
      button.classList.toggle('brief', isBrief);
      time.hidden = isBrief && !isLoading && pane.status !== 'settling';
      button.setAttribute('aria-pressed', String(isChosen));
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
): { setColumns(nColumns: number): void; close(): void } {
  const grid = element('div', { class: 'panes' });
  parent.append(grid);
  let badges: ReturnType<typeof createBadge>[] = [];
  const close = watch(store, ['panes', 'chosen', 'phase'], ({ panes, chosen, phase }) => {
    if (badges.length !== panes.length) {
      badges = panes.map((_, index) => createBadge(() => actions.choose(index)));
      grid.replaceChildren(...badges.map(({ cell }) => cell));
    }
    panes.forEach((pane, index) => {
      badges[index]?.show(pane, index === chosen, panes.length > 4, phase === 'loading');
    });
  });
  return {
    setColumns: (nColumns) => grid.style.setProperty('--columns', String(nColumns)),
    close,
  };
}
