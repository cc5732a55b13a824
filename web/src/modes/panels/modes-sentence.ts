// Sentences that a screen reader hears of the view of modes: events, not running numbers.
import { modelOf } from '../state/models';
import type { ModesState } from '../state/modes-state';
import { storyWords } from './completion-words';
import { ENERGY_TITLES } from './mode-words';

export function modesSentence(state: ModesState, previous: ModesState): string | null {
  if (state.phase === 'ready' && previous.phase === 'loading') {
    const title = modelOf(state.model)?.title ?? state.objName ?? 'Your OBJ';
    return `${title}, ${state.found?.modes.length ?? 0} modes. ${storyWords(state)}`;
  }
  if (state.found !== previous.found && state.found && state.phase === 'ready')
    return `${state.found.modes.length} modes, energy: ${ENERGY_TITLES[state.found.energy]}.`;
  if (state.completion !== previous.completion && state.completion && state.phase === 'ready')
    return storyWords(state);
  if (state.playing !== previous.playing) return state.playing ? 'Playing.' : 'Paused.';
  return null;
}
