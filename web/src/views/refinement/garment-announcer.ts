// Says to a screen reader what happened: events, not running numbers.
import type { RefinementState } from '../../state/refinement-state';
import type { Store } from '../../state/store';
import { element, setText } from '../element';
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

export function createGarmentAnnouncer(
  parent: HTMLElement,
  store: Store<RefinementState>,
): () => void {
  const region = element('p', { class: 'unseen', role: 'status', 'aria-live': 'polite' });
  parent.append(region);
  return store.subscribe((state, previous) => {
    const sentence = garmentSentence(state, previous);
    if (sentence !== null) setText(region, sentence);
  });
}
