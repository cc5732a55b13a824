// Play, pause, step, reset, speed, view, time: one row under the stage.
import { button, element, setText } from '../../shared/panels/element';
import { createRunTools, type Playable } from '../../shared/panels/run-tools';
import { type Store, watch } from '../../shared/state/store';
import type { RefinementState } from '../state/refinement-state';

export interface GarmentToolActions {
  homeView(): void;
  hemView(): void;
  savePicture(): void;
  saveObj(): void;
}

const WORDS = {
  step: 'One frame of 1/30 s (full stop)',
  reset: 'Back to standing still (R)',
  view: 'Look from the first direction (Home)',
  speed: 'shown seconds a second, if the device keeps up',
};

function isAtRest(phase: string): boolean {
  return phase !== 'loading' && phase !== 'broken';
}

export function createGarmentToolbar(
  parent: HTMLElement,
  store: Store<RefinementState>,
  run: Playable,
  actions: GarmentToolActions,
): void {
  createRunTools(parent, store, run, actions.homeView, WORDS, isAtRest);
  const hem = button('Hem', actions.hemView, {
    title: 'Look closely at the hem, where folds are (M)',
  });
  const picture = button('Picture', actions.savePicture, {
    title: 'Saves what is seen as a PNG file',
  });
  const obj = button('OBJ', actions.saveObj, {
    title: 'Saves the multi-resolution cloth as it is now',
  });
  const time = element('output', { class: 'toolbar-time', 'aria-live': 'off' });
  parent.append(hem, picture, obj, time);

  watch(store, ['phase', 'timeS', 'endS'], ({ phase, timeS, endS }) => {
    for (const made of [hem, picture, obj]) made.disabled = !isAtRest(phase);
    setText(time, endS > 0 ? `${timeS.toFixed(2)} s of ${endS.toFixed(0)} s` : '');
  });
}
