// Badges of what each pane shows: the energy whose modes are mixed, and how much of the volume that leaves.
import { element, setText } from '../../shared/panels/element';
import { type Store, watch } from '../../shared/state/store';
import type { Energy } from '../bindings/modal-module';
import type { ModesState } from '../state/modes-state';
import { ENERGY_TITLES, volumeWords } from './mode-words';

const MOST_PANES = 2;

/** Two panes stand beside each other from this width on [px], else one above the other. */
const WIDE_PX = 560;

export function columnsFor(nPanes: number, width: number): number {
  return width >= WIDE_PX ? nPanes : 1;
}

export interface EnergyBadges {
  setColumns(nColumns: number): void;
}

/** `volumeOf` is that of a pane's mix at its full swing over that at rest; null of an open surface. */
export function createEnergyBadges(
  parent: HTMLElement,
  store: Store<ModesState>,
  energiesOf: (state: ModesState) => readonly Energy[],
  volumeOf: (energy: Energy) => number | null,
): EnergyBadges {
  const badges = Array.from({ length: MOST_PANES }, () => element('p', { class: 'energy-badge' }));
  const panes = badges.map((badge) => element('div', { class: 'pane' }, badge));
  const box = element('div', { class: 'panes' }, ...panes);
  parent.append(box);
  const keys: (keyof ModesState)[] = ['showing', 'compares', 'energy', 'found', 'amplitudes'];
  watch(store, keys, (state) => {
    const energies = energiesOf(state);
    panes.forEach((pane, index) => {
      pane.hidden = index >= energies.length || state.showing === 'keys';
    });
    energies.forEach((energy, index) => {
      const badge = badges[index];
      const volume = volumeOf(energy);
      const change = volume === null ? '' : `, ${volumeWords(volume)}`;
      if (badge) setText(badge, `${ENERGY_TITLES[energy]}${change}`);
    });
  });
  return { setColumns: (nColumns) => box.style.setProperty('--columns', String(nColumns)) };
}
