// Reading of the reports of a run: its numbers, what a step takes, and its pace.
import type { RunNumbers } from '../../shared/bindings/pleat-module';
import type { RunReport } from '../../shared/workers/motion-protocol';
import type { MotionState } from '../state/motion-state';
import type { Setting } from '../state/setting';
import { withCost } from '../state/step-cost';
import { createStepTimer } from './step-timing';

/** The pace is measured over this much of the clock [s]. */
const PACE_WINDOW_S = 1;

export class RunReading {
  private readonly timer = createStepTimer();
  private paceFrom = { clockMs: 0, timeS: 0 };

  /** A run begins with these numbers. */
  begin(numbers: RunNumbers): void {
    this.restartPace(numbers.time_s);
    this.timer.clear();
    this.timer.feed(numbers);
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
    return patch;
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
