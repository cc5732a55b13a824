// Messages between the page and the worker that measures, both ways.
import type { Failure } from '../../shared/bindings/answers';
import type { SweepReport } from '../bindings/sweep-module';

/** Runs to its end; to cancel, terminate the worker. */
export interface ToSweep {
  type: 'sweep';
  fabricsText: string;
  planText: string;
}

export type FromSweep =
  | { type: 'sweepReport'; report: SweepReport }
  | { type: 'refused'; failure: Failure };
