// The sentence that a screen reader says of the view of refinement.
import { planStory } from '../state/plan-file';
import type { RefinementState } from '../state/refinement-state';
import { examplesWords, vertices } from './garment-words';

/** The sentence for a change, or null when nothing worth saying happened. */
export function garmentSentence(state: RefinementState, previous: RefinementState): string | null {
  if (state.fit?.first_fired !== null && state.fit && previous.fit?.first_fired == null)
    return 'The motion does not fit the example any more.';
  if (state.phase === 'ready' && previous.phase === 'loading') {
    const count = vertices(state.panes.planned.nVertices);
    const story = state.plan && planStory(state.plan);
    if (!story || story.examples.length < 2) return `Ready: the planned mesh has ${count}.`;
    return `Ready: the mesh planned from the ${examplesWords(story)} has ${count}.`;
  }
  if (!state.playing && previous.playing && state.phase === 'ready')
    return `Paused at ${state.timeS.toFixed(1)} seconds.`;
  return null;
}
