// Play, pause, step, reset, speed, view, time: what is under the stage.
import { button, element, setText } from '../../shared/panels/element';
import { createRunTools, type Playable } from '../../shared/panels/run-tools';
import { type Store, watch } from '../../shared/state/store';
import { FRAME_S } from '../state/garment-frames';
import { canSeek, isComputedHere, type RefinementState } from '../state/refinement-state';

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

/** The time of what is recorded, to be moved; where frames are computed it can only be read. */
function createTime(store: Store<RefinementState>, seek: (timeS: number) => void) {
  let asked: number | null = null; // the frame that the slider is at and the picture not yet
  const slider = element('input', {
    type: 'range',
    min: 0,
    step: 1,
    class: 'time-slider',
    'aria-label': 'Time',
    input() {
      asked = slider.valueAsNumber;
      seek(asked * FRAME_S);
    },
  });
  const text = element('output', { class: 'toolbar-time', 'aria-live': 'off' });
  watch(store, ['phase', 'playing', 'timeS', 'endS', 'panes', 'rival'], (state) => {
    const { playing, timeS, endS } = state;
    const words = endS > 0 ? `${timeS.toFixed(2)} s of ${endS.toFixed(0)} s` : '';
    const shown = Math.round(timeS / FRAME_S);
    if (shown === asked || playing || !canSeek(state)) asked = null;
    slider.hidden = isComputedHere(state);
    slider.disabled = !canSeek(state);
    slider.max = String(Math.round(endS / FRAME_S));
    if (asked === null) slider.value = String(shown);
    slider.setAttribute('aria-valuetext', words);
    setText(text, words);
  });
  return element('div', { class: 'time-row' }, slider, text);
}

function isAtRest(phase: string): boolean {
  return phase !== 'loading' && phase !== 'broken';
}

export function createGarmentToolbar(
  parent: HTMLElement,
  store: Store<RefinementState>,
  run: Playable & { seek(timeS: number): void },
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
  parent.append(
    hem,
    picture,
    obj,
    createTime(store, (timeS) => run.seek(timeS)),
  );
  watch(store, ['phase'], ({ phase }) => {
    for (const made of [hem, picture, obj]) made.disabled = !isAtRest(phase);
  });
}
