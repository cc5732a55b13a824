// Play, pause, step, reset, speed, view, time: one row under the stage.
import { element, setText } from '../../shared/panels/element';
import { createRunTools, type Playable } from '../../shared/panels/run-tools';
import { type Store, watch } from '../../shared/state/store';
import { caseNamed } from '../state/failure-cases';
import type { FailuresState } from '../state/failures-state';

const WORDS = {
  step: 'One step of 1/60 s on both sides (full stop)',
  reset: 'Both sides from the beginning (R)',
  view: 'Look from the first direction (Home)',
  speed: 'simulated seconds a second, if the device keeps up',
};

export function createDuelTools(
  parent: HTMLElement,
  store: Store<FailuresState>,
  run: Playable,
  homeView: () => void,
): void {
  createRunTools(parent, store, run, homeView, WORDS, (phase) =>
    ['ready', 'stopped'].includes(phase),
  );
  const time = element('output', { class: 'toolbar-time', 'aria-live': 'off' });
  parent.append(time);
  watch(store, ['timeS', 'caseId'], ({ timeS, caseId }) => {
    setText(time, `${timeS.toFixed(2)} s of ${caseNamed(caseId).endS} s`);
  });
}
