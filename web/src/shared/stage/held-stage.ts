// A stage with a hand on it, which is in one pane at a time; a vertex in the first pane asks to be taken.
import { Vector3 } from 'three';
import type { Triple } from '../bindings/geometry';
import { type Box, createHand, type Hand } from './grab';
import { createHandMark } from './hand-mark';
import { createPaneStage, type PaneStage, type PaneStageParts } from './pane-stage';

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

export class HeldStage {
  readonly stage: PaneStage;
  inviting = 0;
  /** Nothing is pulled below this height [m]. */
  floor = 0;
  private readonly hand: Hand;
  private readonly mark = createHandMark();
  private active = 0; // pane in which the hand is

  /** Call `stage.open()` once everything that draws is there. */
  constructor(
    parent: HTMLElement,
    canvas: HTMLCanvasElement,
    private readonly parts: HeldStageParts,
    events: HeldStageEvents,
  ) {
    this.stage = createPaneStage(parent, canvas, {
      ...parts,
      objects: [...parts.objects, this.mark.object],
      prepare: (pane) => {
        parts.prepare(pane);
        this.placeMark(pane);
      },
      drawn: () => parts.drawn(this.project(this.inviting, 0)),
      themed: (colour) => {
        this.mark.setColour(colour('--stage-hand'));
        parts.themed(colour);
      },
      handKey: (name) => this.hand.key(name),
      key: events.key,
      pictureLost: events.pictureLost,
    });
    const { camera, control, redraw } = this.stage;
    this.hand = createHand(canvas, camera, {
      picture: (at) => this.pictureAt(at),
      press: (vertex) => events.press?.(vertex, this.active) ?? false,
      grab: (vertex) => {
        control.setResting(true); // while the hand holds the cloth
        events.grab(vertex, this.active);
      },
      move: events.moveGrab,
      release() {
        control.setResting(false);
        events.releaseGrab();
      },
      fallbackVertex: () => this.inviting,
      cloth: () => ({ positions: parts.positions(this.active), triangles: parts.triangles() }),
      floor: () => this.floor,
      onChange: redraw,
    });
  }

  /** Lets go without telling anyone: the cloth is another one. */
  drop(): void {
    this.hand.drop();
    this.stage.control.setResting(false);
  }

  invite(vertex: number): void {
    this.inviting = vertex;
    this.stage.redraw();
  }

  /** Where a vertex is seen, in pixels from the canvas's upper left corner. */
  project(vertex: number, pane: number): { x: number; y: number } {
    return this.stage.grid.project(this.parts.positions(pane), vertex, pane);
  }

  private pictureAt(at: { x: number; y: number } | null): () => Box {
    const { grid } = this.stage;
    const pane = at ? grid.paneAt(at) : (this.parts.chosen?.() ?? 0);
    this.active = pane;
    return () => grid.boxOf(pane);
  }

  /** Marks the hand at the held vertex in its pane, and nowhere in another one. */
  private placeMark(pane: number): void {
    const vertex = pane === this.active ? this.hand.vertex() : null;
    const positions = this.parts.positions(pane);
    const place = vertex === null ? null : new Vector3().fromArray(positions, 3 * vertex);
    this.mark.place(place, this.hand.target(), this.stage.camera);
  }
}
