// Reading of the reports of a run: its numbers, what a step takes, its pace, and what goes wrong.
import type { RunNumbers } from '../../shared/bindings/pleat-module';
import type { RunWarning } from '../../shared/bindings/run-warning';
import type { RunReport } from '../../shared/workers/motion-protocol';
import type { MotionState } from '../state/motion-state';
import type { Setting } from '../state/setting';
import { withCost } from '../state/step-cost';
import { remedyForWarning } from './remedy';
import { createStepTimer } from './step-timing';

/** The pace is measured over this much of the clock [s]. */
const PACE_WINDOW_S = 1;

export class RunReading {
  private readonly timer = createStepTimer();
  private paceFrom = { clockMs: 0, timeS: 0 };
  private nWarned = 0; // warnings of the run that were told

  /** A run begins with these numbers. */
  begin(numbers: RunNumbers): void {
    this.restartPace(numbers.time_s);
    this.timer.clear();
    this.timer.feed(numbers);
    this.nWarned = 0;
  }

  restartPace(timeS: number): void {
    this.paceFrom = { clockMs: performance.now(), timeS };
  }

  /** The change of the state by a report; its steps are of the `loaded` setting. */
  patchOf({ numbers, status }: RunReport, state: MotionState, loaded?: Setting) {
    const patch: Partial<MotionState> = { numbers, isCutShort: status === 'not_converged' };
    const timing = this.timer.feed(numbers);
    if (timing) {
      patch.timing = timing;
      if (loaded) patch.costs = withCost(state.costs, loaded, timing.totalMs);
    }
    const pace = state.playing ? this.pace(numbers.time_s) : null;
    if (pace !== null) patch.pace = pace;
    const problem = this.problemOf(numbers.warnings, state);
    if (problem) patch.problem = problem;
    return patch;
  }

  /** The problem that a new warning is, or the one that is shown, with the remedy that its warning has by now. */
  private problemOf(warnings: readonly RunWarning[], { problem, setting }: MotionState) {
    const [fresh] = warnings.slice(this.nWarned);
    this.nWarned = warnings.length;
    if (fresh)
      return {
        source: 'setting',
        warning: fresh.kind,
        ...remedyForWarning(fresh, setting),
      } as const;
    const known = problem && warnings.find(({ kind }) => kind === problem.warning);
    return known && { ...problem, remedy: remedyForWarning(known, setting).remedy };
  }

  /** Simulated seconds a second, once the window is over. */
  private pace(timeS: number): number | null {
    const clockMs = performance.now();
    const from = this.paceFrom;
    const elapsedS = (clockMs - from.clockMs) / 1000;
    if (elapsedS < PACE_WINDOW_S) return null;
    this.paceFrom = { clockMs, timeS };
    return (timeS - from.timeS) / elapsedS;
  }
}
