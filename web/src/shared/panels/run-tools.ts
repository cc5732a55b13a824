// Play, pause, step, reset, speed, view: what the row under a stage has for a cloth in motion.
import { SPEEDS } from '../state/speeds';
import { type Store, watch } from '../state/store';
import { choice } from './element';
import { toolButton } from './tool-button';

const SPEED_TITLES: Record<number, string> = { 1: '1 ×', 0.5: '1/2 ×', 0.25: '1/4 ×' };

/** The choice of a speed. */
export function speedChoice(onChoice: (speed: number) => void) {
  return choice(
    SPEEDS.map((value) => ({ value, title: SPEED_TITLES[value] ?? String(value) })),
    onChoice,
  );
}

export interface RunState {
  playing: boolean;
  phase: string;
  speed: number;
}

/** A run that can be played. */
export interface Playable {
  play(): void;
  pause(): void;
  step(): void;
  reset(): void;
}

export interface RunWords {
  step: string;
  reset: string;
  view: string;
  /** The unit of a speed, in words. */
  speed: string;
}

/** `canReset` says in which phases a reset is possible. */
export function createRunTools<State extends RunState>(
  parent: HTMLElement,
  store: Store<State>,
  run: Playable,
  homeView: () => void,
  words: RunWords,
  canReset: (phase: string) => boolean,
): void {
  const play = toolButton('play', 'Play', 'Play or pause (space)', () => {
    if (store.get().playing) run.pause();
    else run.play();
  });
  play.made.classList.add('primary');
  const step = toolButton('step', 'Step', words.step, () => run.step());
  const reset = toolButton('reset', 'Reset', words.reset, () => run.reset());
  const view = toolButton('view', 'View', words.view, homeView);
  const speed = speedChoice((value) => store.set({ speed: value } as Partial<State>));
  speed.control.setAttribute('aria-label', `Speed: ${words.speed}`);
  speed.control.title = words.speed.charAt(0).toUpperCase() + words.speed.slice(1);
  parent.append(play.made, step.made, reset.made, speed.control, view.made);

  watch(store, ['playing', 'phase', 'speed'], ({ playing, phase, speed: now }) => {
    if (playing) play.show('pause', 'Pause');
    else play.show('play', 'Play');
    const canRun = phase === 'ready' || phase === 'loading';
    for (const { made } of [play, step]) made.disabled = !canRun;
    reset.made.disabled = !canReset(phase);
    reset.made.classList.toggle('asked', phase === 'stopped');
    speed.select(now);
  });
}
