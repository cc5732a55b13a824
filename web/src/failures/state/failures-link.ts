// The view of failures to a link and back: its case.
import { createLinkReader, oneOf } from '../../shared/state/link-reader';
import { CASES } from './failure-cases';
import { type FailuresState, FIRST_CASE } from './failures-state';

export function encodeFailuresLink({ caseId }: FailuresState): string {
  return `view=failures&case=${caseId}`;
}

export function decodeFailuresLink(hash: string): { caseId: string; problems: string[] } {
  const { take, finish } = createLinkReader(hash, 'failures');
  const ids = CASES.map(({ id }) => id);
  const caseId = take('case', FIRST_CASE, `one of ${ids.join(', ')}`, oneOf(ids));
  return { caseId, problems: finish() };
}
