// Tells a page that a worker has ended, even when it ends without a word: a worker holds a lock for as long
// as it lives, which the browser gives to the page once the worker is gone. A page whose address is not
// secure has no locks, and hears only of ends that come with an error.

function locks(): LockManager | undefined {
  return globalThis.navigator?.locks;
}

/** Takes a lock until the end of this worker; `announce` gets its name once it is held. */
export function holdLife(announce: (name: string) => void): void {
  const name = locks() && crypto.randomUUID();
  if (!name) return;
  void locks()?.request(name, () => {
    announce(name);
    return new Promise(() => undefined);
  });
}

/** Calls `onEnd` once the worker that holds this lock is gone. */
export function watchLife(name: string, onEnd: () => void): void {
  void locks()?.request(name, onEnd);
}
