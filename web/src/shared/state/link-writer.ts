// Keeps the page's address at what a store says, so that it can be sent or opened again.
import type { Store } from './store';

/** Browsers refuse to change an address much more often [ms]. */
const WRITE_EVERY_MS = 400;

/**
 * Writes `link`, the part of the address from `#` on, soon after `store` changes and while `mayWrite`.
 * The returned function writes it at once.
 */
export function createLinkWriter<State extends object>(
  store: Store<State>,
  link: () => string,
  mayWrite: () => boolean,
): () => void {
  let timer = 0;

  function write(): void {
    window.clearTimeout(timer);
    timer = 0;
    if (!mayWrite() || link() === window.location.hash) return;
    window.history.replaceState(null, '', link());
  }

  store.subscribe(() => {
    if (timer === 0) timer = window.setTimeout(write, WRITE_EVERY_MS);
  });
  return write;
}
