// The comparison of methods on one step: it comes when it is first opened.
import { addSection, folded } from '../../../shared/panels/section';
import type { Store } from '../../../shared/state/store';
import { later } from '../../run/later';
import type { MotionRun } from '../../run/motion-run';
import type { MotionState } from '../../state/motion-state';

export function createConvergencePanel(
  parent: HTMLElement,
  store: Store<MotionState>,
  run: Pick<MotionRun, 'rest'>,
): void {
  const box = folded('Convergence: one step by every method', {
    class: 'convergence',
    toggle: () => box.open && void bring(),
  });
  addSection(parent, 'Convergence', box);
  const bring = later(store, 'The comparison of methods', async () => {
    (await import('./convergence-chart')).createConvergenceChart(box, store, run);
  });
}
