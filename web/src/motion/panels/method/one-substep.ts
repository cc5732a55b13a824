// A button that runs the shown cloth in one substep a step, where its method takes more: how too few fail is one press away.
import { button } from '../../../shared/panels/element';
import { type Store, watch } from '../../../shared/state/store';
import { stepperRow } from '../../../shared/steppers/steppers';
import type { MotionRun } from '../../run/motion-run';
import type { MotionState } from '../../state/motion-state';
import type { Setting } from '../../state/setting';

/** Sweeps carry a pull a few cells a substep: what they leave in a single one is seen. */
function isSwept({ stepper, substeps }: Setting): boolean {
  const { settings, solves_whole_substeps } = stepperRow(stepper);
  return settings.iterations !== undefined && !solves_whole_substeps && substeps > 1;
}

/** The button, below the counts in `parent`. */
export function createOneSubstep(
  parent: HTMLElement,
  store: Store<MotionState>,
  run: Pick<MotionRun, 'showAnew'>,
): void {
  const press = button(
    'See what one substep does',
    () => {
      const setting = { ...store.get().setting, substeps: 1 };
      run.showAnew({ setting, startSteps: 0, playing: true, invited: false, problem: null });
    },
    { class: 'wide' },
  );
  parent.querySelector('.row:has(.count-field)')?.after(press);
  watch(store, ['setting'], ({ setting }) => {
    press.hidden = !isSwept(setting);
  });
}
