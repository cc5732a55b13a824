// Play, pause, step, reset, speed, view: one row under the stage.
import { choice, element, setText, svg } from '../../shared/panels/element';
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

/** Drawn on 16 by 16, so that no font has to know them. */
const ICONS = {
  play: 'M4 2.5V13.5L13.5 8Z',
  pause: 'M4 2.5H7V13.5H4ZM9 2.5H12V13.5H9Z',
  step: 'M3 2.5V13.5L10.5 8ZM11 2.5H13.5V13.5H11Z',
  reset: 'M8 2.5A5.5 5.5 0 1 1 2.9 6L4.7 6.7A3.6 3.6 0 1 0 8 4.4V7L3.6 3.5L8 0Z',
  view: 'M8 1.5L15 8H13V14H9.5V10H6.5V14H3V8H1Z',
};

/** A button with a drawing and a word. */
export function toolButton(
  icon: keyof typeof ICONS,
  text: string,
  title: string,
  onClick: () => void,
) {
  const made = element('button', { type: 'button', class: 'tool', title, click: onClick });
  const drawing = svg('svg', { viewBox: '0 0 16 16', 'aria-hidden': 'true' });
  const path = svg('path', {});
  drawing.append(path);
  const label = element('span', {}, text);
  made.append(drawing, label);
  const show = (newIcon: keyof typeof ICONS, newText: string) => {
    path.setAttribute('d', ICONS[newIcon]);
    setText(label, newText);
  };
  show(icon, text);
  return { made, show };
}

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
