// How far a sweep is, by the time that it takes here, and how long the rest of it takes.
import { stepperRow } from '../../shared/steppers/steppers';
import type { BenchRow, SweepReport } from '../bindings/sweep-module';
import { growthOf } from './step-cost';
import { FIRST_ROUND, hasFinished, type PlannedSetting, type SweepPlan } from './sweep-plan';

export interface SweepProgress {
  /** Share of the time of the whole sweep that has passed, 0 to 1. */
  share: number;
  /** Time that the rest is expected to take [s]; null before each setting was measured: first runs are of cold code. */
  leftS: number | null;
}

/** A sweep that is not done has some of it left, whatever was expected. */
const MOST_SHOWN = 0.99;

/** Rows tell the time of a sixtieth of a second. */
const FRAMES_PER_S = 60;

const methodOf = (setting: PlannedSetting) => JSON.stringify(setting['/method']);

/**
 * True once each planned method was measured at some level, so that its runs on other meshes follow from its own
 * there. Methods alone do not tell of each other: per vertex and substep they differ tenfold. Rows come in the order
 * of the plan.
 */
export function tellsTheRest(settings: readonly PlannedSetting[], nRows: number): boolean {
  const measured = new Set(settings.slice(0, nRows).map(methodOf));
  return settings.every((setting) => measured.has(methodOf(setting)));
}

/** Milliseconds of a frame of a planned setting: as measured, or by its method's nearest level; 0 of what failed. */
function msOf(
  index: number,
  settings: readonly PlannedSetting[],
  rows: readonly BenchRow[],
): number {
  const own = rows[index];
  if (own) return hasFinished(own) ? (own.ms_per_frame ?? 0) : 0;
  const setting = settings[index];
  if (!setting) return 0;
  const level = setting['/refinement/level'];
  const { stepper, substeps } = setting['/method'];
  let [nearest, ms] = [Number.POSITIVE_INFINITY, 0];
  rows.forEach((row, at) => {
    const other = settings[at];
    if (!other || methodOf(other) !== methodOf(setting) || !hasFinished(row)) return;
    const away = level - other['/refinement/level'];
    if (Math.abs(away) >= nearest) return;
    nearest = Math.abs(away);
    ms = (row.ms_per_frame ?? 0) * growthOf(stepperRow(stepper), substeps) ** away;
  });
  return ms;
}

/** Time of the runs that are left [s]: in rounds, of which the first is the dearest. */
export function runsLeftS(
  { settings, duration_s, repeats }: Pick<SweepPlan, 'settings' | 'duration_s' | 'repeats'>,
  rows: readonly BenchRow[],
): number {
  const runs = settings.map((_, index) => {
    const row = rows[index];
    const nLeft = row ? repeats - row.n_runs : FIRST_ROUND + repeats;
    return nLeft * msOf(index, settings, rows);
  });
  return (runs.reduce((sum, one) => sum + one, 0) * duration_s * FRAMES_PER_S) / 1000;
}

/**
 * Progress after so long [s]; null while too few rows tell. Where references are made as well, `makes`, the module
 * alone knows what is left of them. Another estimate may say that less has passed than was `before`: it stands still
 * until that is made up for.
 */
export function progressOf(
  { rows, estimated_s: wholeS }: Pick<SweepReport, 'rows' | 'estimated_s'>,
  plan: SweepPlan,
  makes: boolean,
  passedS: number,
  before: number,
): SweepProgress | null {
  if (!tellsTheRest(plan.settings, rows.length)) return null;
  if (makes && wholeS === null) return null;
  const restS = makes ? Math.max((wholeS ?? 0) - passedS, 0) : runsLeftS(plan, rows);
  if (passedS <= 0) return null;
  const share = Math.min(Math.max(passedS / (passedS + restS), before), MOST_SHOWN);
  const isTold = makes || rows.length === plan.settings.length;
  return { share, leftS: isTold ? (passedS * (1 - share)) / share : null };
}
