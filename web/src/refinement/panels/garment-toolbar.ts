// Play, pause, step, reset, speed, view, time: one row under the stage.
import { element, setText } from '../../shared/panels/element';
import { createRunTools, type RunActions } from '../../shared/panels/run-tools';
import { type Store, watch } from '../../shared/state/store';
import type { RefinementState } from '../state/refinement-state';

export interface GarmentToolActions extends RunActions {
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
  actions: GarmentToolActions,
): () => void {
  const stopTools = createRunTools(parent, store, actions, WORDS, isAtRest);
  const button = (title: string, meaning: string, click: () => void) =>
    element('button', { type: 'button', title: meaning, click }, title);
  const hem = button('Hem', 'Look closely at the hem, where folds are (M)', actions.hemView);
  const picture = button('Picture', 'Saves what is seen as a PNG file', actions.savePicture);
  const obj = button('OBJ', 'Saves the multi-resolution cloth as it is now', actions.saveObj);
  const time = element('output', { class: 'toolbar-time', 'aria-live': 'off' });
  parent.append(hem, picture, obj, time);

  const stop = watch(store, ['phase', 'timeS', 'endS'], ({ phase, timeS, endS }) => {
    for (const made of [hem, picture, obj]) made.disabled = !isAtRest(phase);
    setText(time, endS > 0 ? `${timeS.toFixed(2)} s of ${endS.toFixed(0)} s` : '');
  });
  return () => {
    stopTools();
    stop();
  };
}
