// How many recorded or computed frames are due, and when numbers are.
import { FRAME_S } from '../state/garment-frames';

/** Errors and numbers are read this often while it plays [ms]: faster cannot be read. */
const NUMBERS_EVERY_MS = 500;

/** When the display had to wait, as many frames are left out at most to be at real time again. */
const MOST_LEFT_OUT = 3;

export class FramePace {
  private dueFrames = 0;
  private lastTickMs = 0;
  private lastNumbersMs = 0;

  constructor(private readonly nowMs: () => number) {}

  /** Starts to count the time, with one frame due at once. */
  start(): void {
    this.lastTickMs = this.nowMs();
    this.dueFrames = 1;
  }

  /** Lets the time since the last call become due, at so many simulated seconds a second. */
  tick(speed: number): void {
    const nowMs = this.nowMs();
    this.dueFrames += ((nowMs - this.lastTickMs) / 1000 / FRAME_S) * speed;
    this.dueFrames = Math.min(this.dueFrames, MOST_LEFT_OUT);
    this.lastTickMs = nowMs;
  }

  due(): number {
    return Math.floor(this.dueFrames);
  }

  /** Counts these frames as on their way. */
  take(nFrames: number): void {
    this.dueFrames -= nFrames;
  }

  /** Whether the numbers are to be read with the next frame; `isAlways` reads them each time. */
  areNumbersDue(isAlways: boolean): boolean {
    const nowMs = this.nowMs();
    const areDue = isAlways || nowMs - this.lastNumbersMs >= NUMBERS_EVERY_MS;
    if (areDue) this.lastNumbersMs = nowMs;
    return areDue;
  }
}
