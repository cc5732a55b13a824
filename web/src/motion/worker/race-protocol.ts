// Messages between the page and the worker that times imex against implicit, both ways.
import type { Failure } from '../../shared/bindings/answers';

/** Runs to its end; to cancel, terminate the worker. */
export interface ToRace {
  type: 'race';
  fabricsText: string;
  /** Its method is imex. */
  sceneText: string;
}

export interface RacedMessage {
  type: 'raced';
  /** Time of a step of imex in shares of one of implicit; null when one of them did not get through. */
  ratio: number | null;
}

export type FromRace = RacedMessage | { type: 'refused'; failure: Failure };
