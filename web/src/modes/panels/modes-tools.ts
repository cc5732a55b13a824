// The row under the stage: what is shown, play, speed, view, ghost, edges, and the shape as a file.
import { button, checkBox } from '../../shared/panels/element';
import { speedChoice } from '../../shared/panels/run-tools';
import { createSegments, type Segment } from '../../shared/panels/segments';
import { toolButton } from '../../shared/panels/tool-button';
import { type Store, watch } from '../../shared/state/store';
import type { ModesState, Showing } from '../state/modes-state';

export interface ModesToolActions {
  togglePlaying(): void;
  homeView(): void;
  saveObj(): void;
}

const SHOWINGS: readonly Segment<Showing>[] = [
  { value: 'modes', title: 'Modes', meaning: 'The mix of modes, as the sliders have it (M)' },
  { value: 'keys', title: 'Key frames', meaning: 'The motion through the key shapes (M)' },
];

export function createModesTools(
  parent: HTMLElement,
  store: Store<ModesState>,
  actions: ModesToolActions,
): void {
  const play = toolButton('play', 'Play', 'Play or pause (space)', actions.togglePlaying);
  play.made.classList.add('primary');
  const showing = createSegments(
    'showing',
    { class: 'segments showing-switch', 'aria-label': 'What is shown' },
    (value: Showing) => store.set({ showing: value }),
    SHOWINGS,
  );
  const speed = speedChoice((value) => store.set({ speed: value }));
  speed.control.setAttribute('aria-label', 'Speed');
  const view = toolButton(
    'view',
    'View',
    'Look from the first direction again (Home)',
    actions.homeView,
  );
  const ghost = checkBox('Straight ghost', (isOn) => store.set({ ghost: isOn }));
  const edges = checkBox('Edges', (isOn) => store.set({ edges: isOn }));
  const save = button('OBJ', actions.saveObj, { title: 'Saves the shape that is shown' });
  parent.append(
    play.made,
    showing.control,
    speed.control,
    view.made,
    ghost.label,
    edges.label,
    save,
  );
  const keys: (keyof ModesState)[] = ['playing', 'phase', 'showing', 'speed', 'ghost', 'edges'];
  watch(store, keys, (state) => {
    if (state.playing) play.show('pause', 'Pause');
    else play.show('play', 'Play');
    const isReady = state.phase === 'ready';
    play.made.disabled = !isReady;
    save.disabled = !isReady;
    showing.select(state.showing);
    speed.select(state.speed);
    ghost.input.checked = state.ghost;
    ghost.input.disabled = state.showing !== 'keys';
    edges.input.checked = state.edges;
  });
}
