// How many fixed steps are due: the same motion at any display rate, at most at real time.

/** The longest gap between two displayed frames that is made up for [s]; longer ones are dropped. */
const LONGEST_GAP_S = 0.1;

/** Work given to the worker at once [ms]: a release or a pause is obeyed after at most that. */
const LONGEST_BATCH_MS = 40;

export interface Pacer {
  /** Lets `elapsedS` of simulated time become due. */
  advance(elapsedS: number): void;
  /** Takes the whole steps that are due, limited to a batch when a step costs `msPerStep`; one while unknown. */
  take(stepS: number, msPerStep: number | null): number;
  clear(): void;
}

export function createPacer(): Pacer {
  // Rounding may leave a step's time a hair short of a step: an ulp must not cost a whole step.
  const tolerance = 1e-9;
  let dueS = 0;
  return {
    advance(elapsedS) {
      dueS += Math.max(0, elapsedS);
    },
    take(stepS, msPerStep) {
      const due = Math.floor(dueS / stepS + tolerance);
      const affordable = msPerStep === null ? 1 : Math.floor(LONGEST_BATCH_MS / msPerStep);
      const count = Math.min(due, Math.max(1, affordable));
      dueS = Math.min(dueS - count * stepS, Math.max(LONGEST_GAP_S, stepS));
      return count;
    },
    clear() {
      dueS = 0;
    },
  };
}
