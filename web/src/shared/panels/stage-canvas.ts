// The canvas of a stage, and what stands in its place where it cannot be drawn.
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
