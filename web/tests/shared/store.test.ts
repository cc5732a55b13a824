import { describe, expect, it, vi } from 'vitest';
import { createStore, watch } from '../../src/shared/state/store';

describe('store', () => {
  it('tells a change once, with the state before it', () => {
    const store = createStore({ a: 1, b: 2 });
    const listener = vi.fn();
    store.subscribe(listener);
    store.set({ a: 3, b: 2 });
    expect(listener).toHaveBeenCalledTimes(1);
    expect(listener).toHaveBeenCalledWith({ a: 3, b: 2 }, { a: 1, b: 2 });
  });

  it('says nothing when nothing changed', () => {
    const store = createStore({ a: Number.NaN, b: 2 });
    const listener = vi.fn();
    store.subscribe(listener);
    store.set({ a: Number.NaN, b: 2 });
    expect(listener).not.toHaveBeenCalled();
  });

  it('stops telling a listener that unsubscribed', () => {
    const store = createStore({ a: 1 });
    const listener = vi.fn();
    store.subscribe(listener)();
    store.set({ a: 2 });
    expect(listener).not.toHaveBeenCalled();
  });

  it('renders a watched entry at once and then only when it changes', () => {
    const store = createStore({ a: 1, b: 1 });
    const render = vi.fn();
    watch(store, ['a'], render);
    store.set({ b: 2 });
    store.set({ a: 2 });
    expect(render.mock.calls.map(([state]) => state.a)).toEqual([1, 2]);
  });

  it('never renders an older state after a newer one', () => {
    const store = createStore({ a: 1, b: 1 });
    store.subscribe((state) => {
      if (state.a === 2) store.set({ a: 3 });
    });
    const seen: number[] = [];
    watch(store, ['a'], (state) => seen.push(state.a));
    store.set({ a: 2 });
    expect(seen.at(-1)).toBe(3);
    expect(seen).toEqual([...seen].sort());
  });
});
