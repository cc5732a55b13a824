import { describe, expect, it, vi } from 'vitest';
import { later } from '../../src/motion/run/later';
import type { MotionState } from '../../src/motion/state/motion-state';

function store() {
  const problems: string[] = [];
  return {
    problems,
    set({ problem }: Partial<MotionState>) {
      if (problem) problems.push(problem.sentence);
    },
  };
}

describe('a part that comes later', () => {
  it('is fetched when it is first asked for, and once', async () => {
    const fetch = vi.fn(async () => 'chart');
    const bring = later(store(), 'The chart', fetch);
    expect(fetch).not.toHaveBeenCalled();
    expect([await bring(), await bring()]).toEqual(['chart', 'chart']);
    expect(fetch).toHaveBeenCalledTimes(1);
  });

  it('says what could not be fetched, and tries again when it is asked for again', async () => {
    const page = store();
    let isOnline = false;
    const bring = later(page, 'The chart', async () => {
      if (!isOnline) throw new TypeError('no network');
      return 'chart';
    });
    expect(await bring()).toBeNull();
    expect(page.problems).toEqual(['The chart could not be fetched. Try again with a network.']);
    isOnline = true;
    expect(await bring()).toBe('chart');
    expect(page.problems).toHaveLength(1);
  });
});
