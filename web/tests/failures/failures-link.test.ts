import { describe, expect, it } from 'vitest';
import { decodeFailuresLink, encodeFailuresLink } from '../../src/failures/state/failures-link';
import { FIRST_CASE, initialFailuresState } from '../../src/failures/state/failures-state';

describe('link of failures', () => {
  it('is of the first case when it says nothing', () => {
    expect(decodeFailuresLink('#view=failures')).toEqual({
      caseId: FIRST_CASE,
      isNamed: false,
      problems: [],
    });
  });

  it('comes back as it was written', () => {
    const hash = 'view=failures&case=heavy_bead';
    const { caseId, isNamed, problems } = decodeFailuresLink(`#${hash}`);
    expect(isNamed).toBe(true);
    expect(encodeFailuresLink(initialFailuresState(caseId, problems))).toBe(hash);
  });

  it('gives the first case and one sentence for what it cannot read', () => {
    const { caseId, problems } = decodeFailuresLink('#view=failures&case=moon&wind=3');
    expect(caseId).toBe(FIRST_CASE);
    expect(initialFailuresState(caseId, problems).problem?.what).toMatch(
      /^The link: case: expected one of .*, found "moon"; wind: not a known part\.$/,
    );
  });
});
