import { describe, expect, it } from 'vitest';
import { later } from '../../src/motion/panels/later';
import { decodeMotionLink } from '../../src/motion/state/motion-link';
import { initialMotionState } from '../../src/motion/state/motion-state';
import { createStore } from '../../src/shared/state/store';

function storeOfState() {
  const { link } = decodeMotionLink('');
  return createStore({ ...initialMotionState(link, []), energy: true });
}

describe('later', () => {
  it('makes its part once, however often it is asked for', async () => {
    let nMade = 0;
    const make = later(storeOfState(), 'The part', async () => {
      nMade += 1;
    });
    await Promise.all([make(), make()]);
    await make();
    expect(nMade).toBe(1);
  });

  it('says what could not be fetched, sets what goes without it, and tries again', async () => {
    const store = storeOfState();
    let isOffline = true;
    let nMade = 0;
    const make = later(
      store,
      'The part',
      async () => {
        if (isOffline) throw new Error('offline');
        nMade += 1;
      },
      { energy: false },
    );
    await make();
    expect(store.get().problem?.sentence).toMatch(/^The part could not be fetched\./);
    expect(store.get().energy).toBe(false);
    isOffline = false;
    await make();
    expect(nMade).toBe(1);
  });
});
