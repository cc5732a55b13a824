// The time of a view: calls with each picture, how many fixed steps are due (the same motion at any display
// rate, at most at real time), and when numbers are to be read.
import { Latest } from './latest';

/** The longest gap between two displayed frames that is made up for [s]; longer ones are dropped. */
const LONGEST_GAP_S = 0.1;

/** Work given to the worker at once [ms]: a release or a pause is obeyed after at most that. */
const LONGEST_BATCH_MS = 40;

/** Rounding may leave a step's time a hair short of a step: an ulp must not cost a whole step. */
const TOLERANCE = 1e-9;

/** The parts of the browser that a clock needs: tests have their own. */
export interface Display {
  /** Calls back with the next picture. */
  later(callback: () => void): void;
  nowMs(): number;
}

export const DISPLAY: Display = {
  later: (callback) => void requestAnimationFrame(callback),
  nowMs: () => performance.now(),
};

/** The steps that fit into a batch when one costs `msPerStep`; one while that is unknown. */
export function affordable(msPerStep: number | null): number {
  return msPerStep === null ? 1 : Math.max(1, Math.floor(LONGEST_BATCH_MS / msPerStep));
}

export type Clock = ReturnType<typeof createClock>;

export function createClock({ later, nowMs }: Display = DISPLAY) {
  const loops = new Latest();
  let dueS = 0;
  let lastTickMs = 0;
  let lastNumbersMs = 0;

  /** Nothing is due by now. */
  function restart(): void {
    lastTickMs = nowMs();
    dueS = 0;
  }

  /** Lets `elapsedS` of simulated time become due. */
  function advance(elapsedS: number): void {
    dueS += Math.max(0, elapsedS);
  }

  return {
    restart,
    advance,
    /** Starts at nothing due; calls `onPicture` with each picture until it answers false or another call starts. */
    start(onPicture: () => boolean): void {
      const isCurrent = loops.start();
      const next = () =>
        later(() => {
          if (isCurrent() && onPicture()) next();
        });
      restart();
      next();
    },
    /** Lets the time since the last call become due, at so many simulated seconds a second; that time [s]. */
    tick(speed: number): number {
      const now = nowMs();
      const elapsedS = (now - lastTickMs) / 1000;
      lastTickMs = now;
      advance(elapsedS * speed);
      return elapsedS;
    },
    /** Takes the whole steps that are due, `most` of them at once. */
    take(stepS: number, most: number): number {
      const count = Math.min(Math.floor(dueS / stepS + TOLERANCE), most);
      dueS = Math.min(dueS - count * stepS, Math.max(LONGEST_GAP_S, stepS));
      return count;
    },
    /** True once in so many milliseconds, when numbers are to be read; `isAlways` has it so each time. */
    areNumbersDue(everyMs: number, isAlways: boolean): boolean {
      const now = nowMs();
      const areDue = isAlways || now - lastNumbersMs >= everyMs;
      if (areDue) lastNumbersMs = now;
      return areDue;
    },
  };
}
