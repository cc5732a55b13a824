// Messages between the page and the worker that compares methods on one step, both ways. It is told
// once; to cancel, terminate the worker.
import type { Refusal } from '../../shared/bindings/refusals';
import type { ConvergenceStudy } from '../bindings/convergence-module';

export interface ToConvergence {
  type: 'studyConvergence';
  fabricsText: string;
  sceneText: string;
  wishText: string;
}

export type FromConvergence =
  /** Share that is done, 0 to 1. */
  { type: 'progress'; done: number } | { type: 'studied'; study: ConvergenceStudy } | Refusal;
