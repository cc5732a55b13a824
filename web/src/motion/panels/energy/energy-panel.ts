// The account of energy, which is kept only while it is open. What draws it comes when it is first asked for.
import { element } from '../../../shared/panels/element';
import { type Store, watch } from '../../../shared/state/store';
import { later } from '../../run/later';
import type { MotionState } from '../../state/motion-state';

export function createEnergyPanel(parent: HTMLElement, store: Store<MotionState>): void {
  const box = element(
    'details',
    { class: 'energy', toggle: () => store.set({ energy: box.open }) },
    element('summary', {}, 'Energy: where it is and where it goes'),
  );
  parent.append(element('section', { 'aria-label': 'Energy' }, box));
  const bring = later(store, 'The plot of energy', async () => {
    (await import('./energy-chart')).createEnergyChart(box, store);
  });
  watch(store, ['energy'], async ({ energy }) => {
    box.open = energy;
    if (energy && (await bring()) === null) store.set({ energy: false });
  });
}
