import { describe, expect, it } from 'vitest';
import { pathThrough } from '../../src/shared/chart/path-through';

describe('path through points', () => {
  it('joins them by straight lines', () => {
    expect(
      pathThrough([
        [0, 1],
        [2.25, 3],
        [4, 5.04],
      ]),
    ).toBe('M0.0 1.0L2.3 3.0L4.0 5.0');
  });

  it('begins anew after a gap', () => {
    expect(pathThrough([null, [1, 2], null, [3, 4], [5, 6]])).toBe('M1.0 2.0M3.0 4.0L5.0 6.0');
  });
});
