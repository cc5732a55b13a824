// When the next steps of a run are due, how fast it is, and when its numbers are to be read.
import { createPacer } from '../../shared/state/pacer';

/** Numbers are read and shown this often [ms]: faster cannot be read. */
const NUMBERS_EVERY_MS = 200;

/** The pace is measured over this much of the clock [s]. */
const PACE_WINDOW_S = 1;

export class RunClock {
  private readonly pacer = createPacer();
  private lastTickMs = 0;
  private lastNumbersMs = 0;
  /** The moment from which the pace is measured. */
  private mark = { clockMs: 0, timeS: 0 };

  /** The run is at `timeS`, and nothing is due. */
  restart(timeS: number): void {
    this.lastTickMs = performance.now();
    this.mark = { clockMs: this.lastTickMs, timeS };
    this.pacer.clear();
  }

  /** Lets the time since the last call become due, at so many simulated seconds a second. */
  tick(speed: number): void {
    const nowMs = performance.now();
    this.pacer.advance(((nowMs - this.lastTickMs) / 1000) * speed);
    this.lastTickMs = nowMs;
  }

  /** Takes the whole steps that are due and affordable at once. */
  take(stepS: number, msPerStep: number | null): number {
    return this.pacer.take(stepS, msPerStep);
  }

  /** Takes as many of `count` steps as are affordable at once, whatever is due. */
  takeOf(count: number, stepS: number, msPerStep: number): number {
    this.pacer.clear();
    this.pacer.advance(count * stepS);
    const taken = this.pacer.take(stepS, msPerStep);
    this.pacer.clear();
    return taken;
  }

  /** Simulated seconds a second, once the window is over. */
  pace(timeS: number): number | null {
    const clockMs = performance.now();
    const elapsedS = (clockMs - this.mark.clockMs) / 1000;
    if (elapsedS < PACE_WINDOW_S) return null;
    const pace = (timeS - this.mark.timeS) / elapsedS;
    this.mark = { clockMs, timeS };
    return pace;
  }

  /** Whether the numbers are to be read with the next steps; `isAlways` reads them each time. */
  areNumbersDue(isAlways: boolean): boolean {
    const nowMs = performance.now();
    const areDue = isAlways || nowMs - this.lastNumbersMs >= NUMBERS_EVERY_MS;
    if (areDue) this.lastNumbersMs = nowMs;
    return areDue;
  }
}
