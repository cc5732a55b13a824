// Errors as failures, and as words of a worker that it cannot do what it was asked.
import { brokenSentence, describe, type Failure, internalFailure, Refused } from './answers';

/** A worker's word that it cannot do what it was asked. */
export interface Refusal {
  type: 'refused';
  failure: Failure;
}

/** The failure that an error is of. */
export function failureOf(error: unknown): Failure {
  return error instanceof Refused ? error.failure : internalFailure(describe(error));
}

export function refusalOf(error: unknown): Refusal {
  return { type: 'refused', failure: failureOf(error) };
}

/** A worker's end as the failure that it is for what `subject` names. */
export function brokenFailure(subject: string, reason: string): Failure {
  return internalFailure(brokenSentence(subject, reason));
}
