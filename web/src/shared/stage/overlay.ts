// A drawing over a cloth that follows its places and comes to a stage when it is first asked for.
import type { Object3D, Vector3 } from 'three';

export interface Overlay {
  object: Object3D;
  /** Takes positions, three numbers a vertex, to the screen; called before drawing. */
  update(positions: Float32Array, eye: Vector3): void;
  /** The mesh is another one: nothing of the old one is drawn any more. */
  clear(): void;
  /** `colour` reads a variable of the page's design. */
  themed(colour: (name: string) => string): void;
}

/** All that is drawn over the cloth of a stage. */
export function createOverlays() {
  const all: Overlay[] = [];
  let colourOf = (_name: string) => '';
  return {
    add(overlay: Overlay, scene: Object3D): void {
      all.push(overlay);
      scene.add(overlay.object);
      overlay.themed(colourOf);
    },
    update(positions: Float32Array, eye: Vector3): void {
      for (const one of all) one.update(positions, eye);
    },
    clear(): void {
      for (const one of all) one.clear();
    },
    themed(colour: (name: string) => string): void {
      colourOf = colour;
      for (const one of all) one.themed(colour);
    },
  };
}
