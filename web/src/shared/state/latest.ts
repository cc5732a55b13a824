// Tells what belongs to the newest start from what belongs to an earlier one and comes too late.

/** False once something else was started. */
export type IsCurrent = () => boolean;

export class Latest {
  /** The number of the newest start. */
  nStarted = 0;

  /** Starts something: whatever is under way belongs to something earlier from now on. */
  start(): IsCurrent {
    this.nStarted += 1;
    return this.mark();
  }

  /** Marks what belongs to the newest start. */
  mark(): IsCurrent {
    const own = this.nStarted;
    return () => own === this.nStarted;
  }
}
