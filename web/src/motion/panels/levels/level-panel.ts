// Coarser levels of the cloth: what chooses them comes when it is first opened.
import { addSection, folded } from '../../../shared/panels/section';
import { type Store, watch } from '../../../shared/state/store';
import { later } from '../../run/later';
import type { MotionState } from '../../state/motion-state';

export function createLevelPanel(parent: HTMLElement, store: Store<MotionState>): void {
  const box = folded('Levels: coarser meshes of the cloth', {
    class: 'coarse',
    toggle: () => box.open && void bring(),
  });
  addSection(parent, 'Levels', box);
  const bring = later(store, 'What chooses a level', async () => {
    (await import('./level-form')).createLevelForm(box, store);
  });
  watch(store, ['coarse'], ({ coarse }) => {
    if (coarse > 0) box.open = true;
  });
}
