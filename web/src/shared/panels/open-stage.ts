// Opens a stage, and says where it cannot be drawn or is lost.
import { type Failure, inputFailure } from '../bindings/answers';
import type { Store } from '../state/store';
import { PICTURE_LOST, replaceCanvas } from './stage-canvas';

/** Says in `store` that the browser took the picture away, until it gives it back. */
function pictureLostIn(store: Store<{ problem: Failure | null }>): (isLost: boolean) => void {
  return (isLost) => {
    if (isLost) store.set({ problem: inputFailure(PICTURE_LOST) });
    else if (store.get().problem?.what === PICTURE_LOST) store.set({ problem: null });
  };
}

/** The stage that `create` makes; null where the browser cannot draw it, which a sentence in its place says. */
export function openStage<Stage>(
  canvas: HTMLCanvasElement,
  store: Store<{ problem: Failure | null }>,
  create: (pictureLost: (isLost: boolean) => void) => Stage,
): Stage | null {
  try {
    return create(pictureLostIn(store));
  } catch {
    replaceCanvas(canvas, 'The numbers');
    return null;
  }
}
