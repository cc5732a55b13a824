// Panel of what contact makes of cloth that comes down: shown where there are solids, studied while it is open.
import { folded } from '../../../shared/panels/section';
import { type Store, watch } from '../../../shared/state/store';
import { later } from '../../run/later';
import type { MotionState } from '../../state/motion-state';

export function createContactPanel(parent: HTMLElement, store: Store<MotionState>): void {
  const box = folded('Contact: cloth that rests, and cloth that bounces', {
    class: 'contact',
    toggle: () => void open(),
  });
  parent.append(box);
  const bring = later(store, 'The figure of contact', async () => {
    const { createContactChart } = await import('./contact-chart');
    return createContactChart(box, store);
  });
  async function open(): Promise<void> {
    if (box.open) (await bring())?.follow();
  }
  watch(store, ['colliders'], ({ colliders }) => {
    box.hidden = colliders.length === 0;
  });
}
