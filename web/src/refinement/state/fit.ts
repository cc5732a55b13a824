// The share by which a light tells whether a motion fits the plan's examples.
import type { FitAnswer } from '../bindings/refinement-module';
import { FRAMES_TO_FIRE } from './garment-frames';

export interface Fit extends FitAnswer {
  /** Largest share of the faces so far that lasted for FRAMES_TO_FIRE frames in a row: it decides. */
  lasting_share: number;
}

/** Follows the shares of frames, one after the other. */
export class LastingShare {
  private readonly latest: number[] = [];
  private largest = 0;

  /** Takes the next frame's; answers with the largest that lasted so far. */
  add(share: number): number {
    this.latest.push(share);
    if (this.latest.length > FRAMES_TO_FIRE) this.latest.shift();
    if (this.latest.length === FRAMES_TO_FIRE)
      this.largest = Math.max(this.largest, Math.min(...this.latest));
    return this.largest;
  }
}
