// Locks as a browser has them: each goes to the next who asked for it when its holder is gone.
import { vi } from 'vitest';

type Holder = () => unknown;

/** Puts them in the place of the browser's; `endAll` ends every present holder. */
export function stubLocks(): { endAll(): void } {
  const queues = new Map<string, Holder[]>();
  const request = (name: string, holder: Holder) => {
    const queue = queues.get(name) ?? [];
    queues.set(name, [...queue, holder]);
    if (queue.length === 0) holder();
    return Promise.resolve();
  };
  vi.stubGlobal('navigator', { locks: { request }, onLine: true });
  return {
    endAll() {
      for (const [name, [, ...waiting]] of [...queues]) {
        queues.set(name, waiting);
        waiting[0]?.();
      }
    },
  };
}
