// Play, pause, step, reset, speed, view: one row under the stage.
import { choice } from '../../shared/panels/element';
import { toolButton } from '../../shared/panels/tool-button';
import { type Store, watch } from '../../shared/state/store';
import type { MotionRun } from '../run/motion-run';
import type { MotionState } from '../state/motion-state';

export interface MotionToolbarActions extends Pick<MotionRun, 'play' | 'pause' | 'step' | 'reset'> {
  homeView(): void;
}

const SPEEDS = [
  { value: 1, title: '1 ×' },
  { value: 0.5, title: '1/2 ×' },
  { value: 0.25, title: '1/4 ×' },
];

export function createMotionToolbar(
  parent: HTMLElement,
  store: Store<MotionState>,
  actions: MotionToolbarActions,
): () => void {
  const play = toolButton('play', 'Play', 'Play or pause (space)', () => {
    if (store.get().playing) actions.pause();
    else actions.play();
  });
  play.made.classList.add('primary');
  const step = toolButton('step', 'Step', 'One step (full stop)', actions.step);
  const reset = toolButton('reset', 'Reset', 'Back to the start (R)', actions.reset);
  const view = toolButton(
    'view',
    'View',
    'Look from the first direction again (Home)',
    actions.homeView,
  );
  const speed = choice(SPEEDS, (value) => store.set({ speed: value }));
  speed.control.setAttribute('aria-label', 'Speed: simulated seconds a second');
  speed.control.title = 'Simulated seconds a second';
  parent.append(play.made, step.made, reset.made, speed.control, view.made);

  return watch(store, ['playing', 'phase', 'speed'], ({ playing, phase, speed: now }) => {
    if (playing) play.show('pause', 'Pause');
    else play.show('play', 'Play');
    const canRun = phase === 'ready' || phase === 'loading';
    play.made.disabled = !canRun;
    step.made.disabled = !canRun;
    reset.made.disabled = phase === 'broken';
    reset.made.classList.toggle('asked', phase === 'stopped');
    speed.select(now);
  });
}
