// Savings of imex at some length of a substep: springs that need not be implicit, and time.
export interface ImexSaving {
  nSprings: number;
  substepS: number;
  /** Share of the springs that are implicit: 0 to 1. */
  share: number;
  /** Time of a step, in shares of a step of implicit; null where it could not be measured. */
  time: number | 'unasked' | 'measuring' | null;
}
