// Play, pause, step, reset, speed, view: one row under the stage.
import type { Session } from '../sim/session';
import type { AppState } from '../state/app-state';
import { type Store, watch } from '../state/store';
import { choice, element, setText } from './element';

export interface ToolbarActions extends Pick<Session, 'play' | 'pause' | 'step' | 'reset'> {
  homeView(): void;
}

const SPEEDS = [
  { value: 1, title: '1 ×' },
  { value: 0.5, title: '1/2 ×' },
  { value: 0.25, title: '1/4 ×' },
];

function button(icon: string, text: string, title: string, onClick: () => void) {
  const label = element('span', { class: 'tool-text' }, text);
  const mark = element('span', { class: 'tool-icon', 'aria-hidden': 'true' }, icon);
  const made = element(
    'button',
    { type: 'button', class: 'tool', title, click: onClick },
    mark,
    label,
  );
  return { made, label, mark };
}

export function createToolbar(
  parent: HTMLElement,
  store: Store<AppState>,
  actions: ToolbarActions,
): () => void {
  const play = button('▶', 'Play', 'Play or pause (space)', () => {
    if (store.get().playing) actions.pause();
    else actions.play();
  });
  play.made.classList.add('primary');
  const step = button('⏭', 'Step', 'One step (full stop)', actions.step);
  const reset = button('↺', 'Reset', 'Back to the start (R)', actions.reset);
  const view = button('⌂', 'View', 'Look from the first direction again (Home)', actions.homeView);
  const speed = choice(SPEEDS, (value) => store.set({ speed: value }));
  speed.control.setAttribute('aria-label', 'Speed: simulated seconds a second');
  speed.control.title = 'Simulated seconds a second';
  parent.append(play.made, step.made, reset.made, speed.control, view.made);

  return watch(store, ['playing', 'phase', 'speed'], ({ playing, phase, speed: now }) => {
    setText(play.label, playing ? 'Pause' : 'Play');
    setText(play.mark, playing ? '❚❚' : '▶');
    const canRun = phase === 'ready' || phase === 'loading';
    play.made.disabled = !canRun;
    step.made.disabled = !canRun;
    reset.made.disabled = phase === 'broken';
    reset.made.classList.toggle('asked', phase === 'stopped');
    speed.select(now);
  });
}
