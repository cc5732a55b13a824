// The canvas of a stage, and what stands in its place where it cannot be drawn.
import { type Failure, inputFailure } from '../bindings/answers';
import type { Store } from '../state/store';
import { element } from './element';

export const PICTURE_LOST =
  'The browser took the graphics away for a moment. Reload if the picture stays empty.';

/** A canvas that takes keys; `label` says what it shows and which they are. */
export function createStageCanvas(stageBox: HTMLElement, label: string): HTMLCanvasElement {
  const canvas = element('canvas', { tabindex: 0, role: 'application', 'aria-label': label });
  stageBox.append(canvas);
  return canvas;
}

/** Puts a sentence in the canvas's place, and returns it; `rest` is what still works. */
export function replaceCanvas(canvas: HTMLElement, rest: string): string {
  const sentence = `This browser shows no WebGL 2, so the cloth cannot be drawn. ${rest} still work.`;
  canvas.parentElement?.classList.add('undrawn');
  canvas.parentElement?.prepend(element('p', { class: 'plain' }, sentence));
  canvas.remove();
  return sentence;
}

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
