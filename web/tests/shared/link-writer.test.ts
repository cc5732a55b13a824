import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { createLinkWriter } from '../../src/shared/state/link-writer';
import { createStore } from '../../src/shared/state/store';

describe('link writer', () => {
  const location = { hash: '' };
  const replaceState = vi.fn((_state: unknown, _title: string, link: string) => {
    location.hash = link;
  });

  beforeEach(() => {
    vi.useFakeTimers();
    location.hash = '#a=1';
    replaceState.mockClear();
    vi.stubGlobal('window', { location, history: { replaceState }, setTimeout, clearTimeout });
  });
  afterEach(() => {
    vi.useRealTimers();
    vi.unstubAllGlobals();
  });

  function create(mayWrite = () => true) {
    const store = createStore({ a: 1, b: 1 });
    return { store, write: createLinkWriter(store, () => `#a=${store.get().a}`, mayWrite) };
  }

  it('writes many changes once, and as they are then', () => {
    const { store } = create();
    for (const a of [2, 3, 4]) {
      store.set({ a });
      vi.advanceTimersByTime(100);
    }
    expect(location.hash).toBe('#a=1');
    vi.advanceTimersByTime(100);
    expect(location.hash).toBe('#a=4');
    store.set({ a: 5 });
    vi.advanceTimersByTime(399);
    expect(location.hash).toBe('#a=4');
    vi.advanceTimersByTime(1);
    expect(location.hash).toBe('#a=5');
    expect(replaceState).toHaveBeenCalledTimes(2);
  });

  it('leaves an address alone that says it already', () => {
    const { store } = create();
    store.set({ b: 2 });
    vi.advanceTimersByTime(400);
    expect(replaceState).not.toHaveBeenCalled();
  });

  it('asks whether it may when it writes, not when the store changes', () => {
    let isShown = true;
    const { store, write } = create(() => isShown);
    store.set({ a: 2 });
    isShown = false;
    vi.advanceTimersByTime(400);
    expect(location.hash).toBe('#a=1');
    isShown = true;
    write();
    expect(location.hash).toBe('#a=2');
  });

  it('writes at once when told to, and later changes a while after that', () => {
    const { store, write } = create();
    store.set({ a: 2 });
    vi.advanceTimersByTime(300);
    write();
    expect(location.hash).toBe('#a=2');
    store.set({ a: 3 });
    vi.advanceTimersByTime(300);
    expect(location.hash).toBe('#a=2');
    vi.advanceTimersByTime(100);
    expect(location.hash).toBe('#a=3');
  });
});
