// One observable value. Panels render from it and set it; nothing else is shared between them.

export interface Store<State> {
  get(): State;
  /** Merges `patch`; listeners hear of it once, and only if some entry is another one. */
  set(patch: Partial<State>): void;
  subscribe(listener: (state: State, previous: State) => void): () => void;
}

export function createStore<State extends object>(initial: State): Store<State> {
  let state = initial;
  const listeners = new Set<(state: State, previous: State) => void>();
  return {
    get: () => state,
    set(patch) {
      const keys = Object.keys(patch) as (keyof State)[];
      if (keys.every((key) => Object.is(state[key], patch[key]))) return;
      const previous = state;
      state = { ...state, ...patch };
      const present = state;
      for (const listener of [...listeners]) listener(present, previous);
    },
    subscribe(listener) {
      listeners.add(listener);
      return () => listeners.delete(listener);
    },
  };
}

/**
 * Calls `render` now and whenever one of the selected entries changes. It gets the newest state:
 * a listener before it may have set the store again.
 */
export function watch<State extends object>(
  store: Store<State>,
  keys: (keyof State)[],
  render: (state: State) => void,
): () => void {
  render(store.get());
  return store.subscribe((state, previous) => {
    if (keys.some((key) => !Object.is(state[key], previous[key]))) render(store.get());
  });
}
