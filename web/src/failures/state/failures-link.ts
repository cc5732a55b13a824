// The view of failures to a link and back: its case.
import { createLinkReader, oneOf } from '../../shared/state/link-reader';
import { CASES } from './failure-cases';
import { type FailuresState, FIRST_CASE } from './failures-state';

export function encodeFailuresLink({ caseId }: FailuresState): string {
  return `view=failures&case=${caseId}`;
}

interface FailuresLink {
  caseId: string;
  /** The link says which case. */
  isNamed: boolean;
  problems: string[];
}

export function decodeFailuresLink(hash: string): FailuresLink {
  const { take, finish } = createLinkReader(hash, 'failures');
  const ids = CASES.map(({ id }) => id);
  const named = take('case', null, `one of ${ids.join(', ')}`, oneOf(ids));
  return { caseId: named ?? FIRST_CASE, isNamed: named !== null, problems: finish() };
}
