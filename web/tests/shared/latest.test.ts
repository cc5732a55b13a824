import { expect, it } from 'vitest';
import { Latest } from '../../src/shared/state/latest';

it('latest: what belongs to an earlier start is not current any more', () => {
  const latest = new Latest();
  const before = latest.mark();
  const first = latest.start();
  expect([before(), first()]).toEqual([false, true]);
  const beside = latest.mark();
  const second = latest.start();
  expect([first(), beside(), second()]).toEqual([false, false, true]);
});
