// The account of energy, which is kept only while it is open. What draws it comes when it is first asked for.
import { addSection, folded } from '../../../shared/panels/section';
import { type Store, watch } from '../../../shared/state/store';
import { later } from '../../run/later';
import type { MotionState } from '../../state/motion-state';

export function createEnergyPanel(parent: HTMLElement, store: Store<MotionState>): void {
  const box = folded('Energy: where it is and where it goes', {
    class: 'energy',
    toggle: () => store.set({ energy: box.open }),
  });
  addSection(parent, 'Energy', box);
  const bring = later(store, 'The plot of energy', async () => {
    (await import('./energy-chart')).createEnergyChart(box, store);
  });
  watch(store, ['energy'], async ({ energy }) => {
    box.open = energy;
    if (energy && (await bring()) === null) store.set({ energy: false });
  });
}
