// A stage with a hand on it, which is in one pane at a time; a vertex in the first pane asks to be taken.
import { Vector3 } from 'three';
import type { Triple } from '../bindings/geometry';
import { createHand } from './grab';
import { createHandMark } from './hand-mark';
import { createPaneStage, type PaneStageParts } from './pane-stage';

/** Actions of a visitor on a stage. */
export interface HeldStageEvents {
  /** True when a press on this vertex is used up otherwise. */
  press?(vertex: number, pane: number): boolean;
  grab(vertex: number, pane: number): void;
  moveGrab(target: Triple): void;
  releaseGrab(): void;
  /** Keys that are neither the camera's nor the hand's. True when used. */
  key(name: string): boolean;
  pictureLost(isLost: boolean): void;
}

export interface HeldStageParts
  extends Omit<PaneStageParts, 'handKey' | 'key' | 'drawn' | 'pictureLost'> {
  positions(pane: number): Float32Array;
  triangles(): Uint32Array;
  /** The pane that keys take the cloth in; the first without. */
  chosen?(): number;
  /** Hears of each picture: where the inviting vertex is in the first pane, in pixels. */
  drawn(invitation: { x: number; y: number }): void;
}

/** Call `stage.open()` once everything that draws is there. */
export function createHeldStage(
  parent: HTMLElement,
  canvas: HTMLCanvasElement,
  parts: HeldStageParts,
  events: HeldStageEvents,
) {
  const mark = createHandMark();
  let inviting = 0;
  let floor = 0; // nothing is pulled below this height [m]
  let active = 0; // pane in which the hand is

  /** Marks the hand at the held vertex in its pane, and nowhere in another one. */
  function placeMark(pane: number): void {
    const vertex = pane === active ? hand.vertex() : null;
    const positions = parts.positions(pane);
    const place = vertex === null ? null : new Vector3().fromArray(positions, 3 * vertex);
    mark.place(place, hand.target(), stage.camera);
  }

  /** Pixels from the canvas's upper left corner to a vertex. */
  function project(vertex: number, pane: number): { x: number; y: number } {
    return grid.project(parts.positions(pane), vertex, pane);
  }

  const stage = createPaneStage(parent, canvas, {
    ...parts,
    ...events,
    objects: [...parts.objects, mark.object],
    prepare(pane) {
      parts.prepare(pane);
      placeMark(pane);
    },
    drawn: () => parts.drawn(project(inviting, 0)),
    themed(colour) {
      mark.setColour(colour('--stage-hand'));
      parts.themed(colour);
    },
    handKey: (name) => hand.key(name),
  });
  const { grid, control, redraw } = stage;
  const hand = createHand(canvas, stage.camera, {
    picture(at) {
      const pane = at ? grid.paneAt(at) : (parts.chosen?.() ?? 0);
      active = pane;
      return () => grid.boxOf(pane);
    },
    press: (vertex) => events.press?.(vertex, active) ?? false,
    grab(vertex) {
      control.setResting(true); // while the hand holds the cloth
      events.grab(vertex, active);
    },
    move: events.moveGrab,
    release() {
      control.setResting(false);
      events.releaseGrab();
    },
    fallbackVertex: () => inviting,
    cloth: () => ({ positions: parts.positions(active), triangles: parts.triangles() }),
    floor: () => floor,
    onChange: redraw,
  });

  return {
    stage,
    project,
    /** Lets go without telling anyone: the cloth is another one. */
    drop(): void {
      hand.drop();
      control.setResting(false);
    },
    inviting: () => inviting,
    invite(vertex: number): void {
      inviting = vertex;
      redraw();
    },
    setFloor(height: number): void {
      floor = height;
    },
  };
}
