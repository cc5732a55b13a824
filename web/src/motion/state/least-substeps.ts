// The substeps that a stepper takes at least to hold a sheet of so many cells together.
import type { StepperRow } from '../../shared/steppers/steppers';

/** Steps for which the rule was measured [s]. */
const FRAME_S = 1 / 60;

/**
 * A thread of n cells is left too long, in s substeps of i sweeps, by a share of n² / (s² i): weight moves it by 1/s²
 * a substep, and a sweep carries a pull by one cell. Sheets of 16 to 64 cells (levels 0 to 3) hold together from this
 * s √i / n on, but for two scenes of the page that take more; coarser levels carry a pull farther.
 */
const SWEPT = 1.25;
const WITH_LEVELS = 0.25;

export function leastSubsteps(
  { settings, details, solves_whole_substeps }: StepperRow,
  nCells: number,
  stepS: number,
): number {
  const { iterations } = settings;
  if (!iterations || solves_whole_substeps) return 1;
  const perCell = ('levels' in details ? WITH_LEVELS : SWEPT) / Math.sqrt(Number(iterations.start));
  return Math.ceil((perCell * nCells * stepS) / FRAME_S);
}
