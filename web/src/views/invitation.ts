// The one thing that asks to be grabbed, until someone grabs or plays.
import type { AppState } from '../state/app-state';
import { type Store, watch } from '../state/store';
import { element } from './element';

export interface Invitation {
  /** Pixels from the stage's upper left corner. */
  place(x: number, y: number): void;
  close(): void;
}

export function createInvitation(parent: HTMLElement, store: Store<AppState>): Invitation {
  const word = element('span', { class: 'invitation-word' }, 'Pull me');
  const ring = element(
    'div',
    { class: 'invitation', 'aria-hidden': 'true' },
    element('span', { class: 'invitation-ring' }),
    word,
  );
  parent.append(ring);
  const close = watch(store, ['invited', 'phase', 'ahead'], ({ invited, phase, ahead }) => {
    ring.hidden = !invited || phase !== 'ready' || ahead !== null;
  });
  return {
    place(x, y) {
      ring.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
      // The word stays inside the stage when the cloth is at its rim.
      const half = word.offsetWidth / 2 + 4;
      const inside = Math.min(parent.clientWidth - half, Math.max(half, x));
      word.style.left = `${(inside - x).toFixed(1)}px`;
    },
    close,
  };
}
