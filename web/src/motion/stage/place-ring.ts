// A ring around one vertex of the cloth, with a word, which follows it on the stage.
import { Group } from 'three';
import { element } from '../../shared/panels/element';
import type { Overlay } from '../../shared/stage/overlay';

export interface PlaceRing extends Overlay {
  /** Null takes it away. */
  show(vertex: number | null): void;
}

/** `project`: pixels from the stage's upper left corner to a vertex, as it was drawn last. */
export function createPlaceRing(
  parent: HTMLElement,
  project: (vertex: number) => { x: number; y: number },
): PlaceRing {
  const word = element('span', { class: 'place-word' }, 'First seen here');
  const box = element(
    'div',
    { class: 'place', 'aria-hidden': 'true' },
    element('span', { class: 'place-ring' }),
    word,
  );
  box.hidden = true;
  parent.append(box);
  let shown: number | null = null;

  function place(): void {
    if (shown === null) return;
    const { x, y } = project(shown);
    box.hidden = !Number.isFinite(x + y);
    box.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    // The word stays inside the stage when the vertex is at its rim.
    const half = word.offsetWidth / 2 + 4;
    const inside = Math.min(parent.clientWidth - half, Math.max(half, x));
    word.style.left = `${(inside - x).toFixed(1)}px`;
  }

  return {
    object: new Group(),
    show(vertex) {
      shown = vertex;
      box.hidden = vertex === null;
    },
    update(positions) {
      if (shown !== null && 3 * shown >= positions.length) this.show(null);
      queueMicrotask(place); // the camera is that of the picture then
    },
    clear() {
      this.show(null);
    },
    themed: () => undefined,
  };
}
