// Sentences that a screen reader says of the view of fabrics.
import { titleOf } from '../state/fabric-choice';
import type { FabricsState } from '../state/fabrics-state';

function isFound({ panes, isDragging }: FabricsState): boolean {
  return !isDragging && panes.every(({ status }) => status !== 'dragging' && status !== 'settling');
}

/** The sentence for a change, or null when nothing worth saying happened. */
export function fabricsSentence(state: FabricsState, previous: FabricsState): string | null {
  if (state.holds.length > previous.holds.length && previous.cloth === state.cloth)
    return `Held at ${state.holds.at(-1)?.name}.`;
  const released = previous.holds.find(
    ({ name }) => !state.holds.some((hold) => hold.name === name),
  );
  if (released && previous.cloth === state.cloth) return `Released ${released.name}.`;
  if (isFound(state) && !isFound(previous)) {
    const names = state.gallery ? 'all fabrics' : state.panes.map(({ fabric }) => titleOf(fabric));
    return `Found the shape of ${[names].flat().join(', ')}.`;
  }
  return null;
}
