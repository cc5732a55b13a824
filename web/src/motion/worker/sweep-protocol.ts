// Messages between the page and the worker that measures, both ways.
import type { Refusal } from '../../shared/bindings/refusals';
import type { SweepReport } from '../bindings/sweep-module';

/** Plans a sweep; another plan takes its place. */
export interface PlanMessage {
  type: 'plan';
  fabricsText: string;
  planText: string;
}

/** Hands over files of references, which are then not computed. */
export interface KeepMessage {
  type: 'keep';
  references: ArrayBuffer[];
}

/** Runs what is planned to its end; to cancel, terminate the worker. */
export interface MeasureMessage {
  type: 'measure';
}

export type ToSweep = PlanMessage | KeepMessage | MeasureMessage;

export interface PlannedMessage {
  type: 'planned';
  /** Ids of what the rows are compared with. */
  references: string[];
}

export type FromSweep = PlannedMessage | { type: 'sweepReport'; report: SweepReport } | Refusal;
