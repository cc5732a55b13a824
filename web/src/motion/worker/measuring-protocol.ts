// Messages between the page and a worker that measures a scene beside the shown cloth, both ways. It
// runs to its end; to cancel, terminate the worker.

import type { ResponseStudy } from '../../shared/bindings/pleat-module';
import type { Refusal } from '../../shared/bindings/refusals';

export interface ToRace {
  type: 'race';
  fabricsText: string;
  /** Its method is imex. */
  sceneText: string;
}

export interface ToStudy {
  type: 'studyResponse';
  fabricsText: string;
  sceneText: string;
  /** Time that is studied after first contact [s]. */
  windowS: number;
}

export type ToMeasuring = ToRace | ToStudy;

export interface RacedMessage {
  type: 'raced';
  /** Time of a step of imex in shares of one of implicit; null when one of them did not get through. */
  ratio: number | null;
}

export interface StudiedMessage {
  type: 'studied';
  study: ResponseStudy;
}

export type FromMeasuring = RacedMessage | StudiedMessage | Refusal;
