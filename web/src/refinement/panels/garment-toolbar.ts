// Play, pause, step, reset, speed, view, time: one row under the stage.

import { choice, element, setText } from '../../shared/panels/element';
import { toolButton } from '../../shared/panels/tool-button';
import { type Store, watch } from '../../shared/state/store';
import type { Trio } from '../run/trio';
import { type RefinementState, SPEEDS } from '../state/refinement-state';

const SPEED_TITLES: Record<number, string> = { 1: '1 ×', 0.5: '1/2 ×', 0.25: '1/4 ×' };

export interface GarmentToolActions extends Pick<Trio, 'play' | 'pause' | 'step' | 'reset'> {
  homeView(): void;
  savePicture(): void;
  saveObj(): void;
}

export function createGarmentToolbar(
  parent: HTMLElement,
  store: Store<RefinementState>,
  actions: GarmentToolActions,
): () => void {
  const play = toolButton('play', 'Play', 'Play or pause (space)', () => {
    if (store.get().playing) actions.pause();
    else actions.play();
  });
  play.made.classList.add('primary');
  const step = toolButton('step', 'Step', 'One frame of 1/30 s (full stop)', actions.step);
  const reset = toolButton('reset', 'Reset', 'Back to standing still (R)', actions.reset);
  const view = toolButton('view', 'View', 'Look from the first direction (Home)', actions.homeView);
  const speed = choice(
    SPEEDS.map((value) => ({ value, title: SPEED_TITLES[value] ?? String(value) })),
    (value) => store.set({ speed: value }),
  );
  speed.control.setAttribute('aria-label', 'Speed: shown seconds a second, if the device keeps up');
  speed.control.title = 'Shown seconds a second, if the device keeps up';
  const save = (title: string, meaning: string, click: () => void) =>
    element('button', { type: 'button', title: meaning, click }, title);
  const picture = save('Picture', 'Saves what is seen as a PNG file', actions.savePicture);
  const obj = save('OBJ', 'Saves the multi-resolution cloth as it is now', actions.saveObj);
  const time = element('output', { class: 'toolbar-time', 'aria-live': 'off' });
  parent.append(play.made, step.made, reset.made, speed.control, view.made, picture, obj, time);

  return watch(store, ['playing', 'phase', 'speed', 'timeS', 'endS'], (state) => {
    const { playing, phase, timeS, endS } = state;
    if (playing) play.show('pause', 'Pause');
    else play.show('play', 'Play');
    const canRun = phase === 'ready' || phase === 'loading';
    for (const { made } of [play, step]) made.disabled = !canRun;
    reset.made.disabled = phase === 'broken' || phase === 'loading';
    reset.made.classList.toggle('asked', phase === 'stopped');
    for (const button of [picture, obj])
      button.disabled = phase === 'loading' || phase === 'broken';
    speed.select(state.speed);
    setText(time, endS > 0 ? `${timeS.toFixed(2)} s of ${endS.toFixed(0)} s` : '');
  });
}
