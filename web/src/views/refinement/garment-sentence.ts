// What a screen reader says of the view of refinement.
import type { RefinementState } from '../../state/refinement-state';
import { vertices } from './garment-words';

/** The sentence for a change, or null when nothing worth saying happened. */
export function garmentSentence(state: RefinementState, previous: RefinementState): string | null {
  if (state.fit?.first_fired !== null && state.fit && previous.fit?.first_fired == null)
    return 'The motion does not fit the example any more.';
  if (state.phase === 'ready' && previous.phase === 'loading')
    return `Ready: the planned mesh has ${vertices(state.panes.planned.nVertices)}.`;
  if (!state.playing && previous.playing && state.phase === 'ready')
    return `Paused at ${state.timeS.toFixed(1)} seconds.`;
  return null;
}
