// The two buffers of a run's frames: one is shown, the other one is here to be filled or on its way.
import type { Scalar } from '../../shared/bindings/frame';

export class RunFrames {
  private spare: ArrayBuffer | null = null;
  shown: ArrayBuffer | null = null;
  /** The numbers that the shown frame holds beside positions. */
  scalar: Scalar = 'stretch';

  /** The buffers of another mesh. */
  replace([shown, spare]: [ArrayBuffer, ArrayBuffer], scalar: Scalar): void {
    this.shown = shown;
    this.spare = spare;
    this.scalar = scalar;
  }

  /** The buffer to be filled, which is given away. */
  take(): ArrayBuffer | null {
    const { spare } = this;
    this.spare = null;
    return spare;
  }

  /** A filled buffer is shown from now on. */
  show(buffer: ArrayBuffer, scalar: Scalar): void {
    this.spare = this.shown;
    this.shown = buffer;
    this.scalar = scalar;
  }
}
