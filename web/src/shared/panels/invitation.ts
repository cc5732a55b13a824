// The one thing that asks to be grabbed.
import { element } from './element';

export function createInvitation(parent: HTMLElement) {
  const word = element('span', { class: 'invitation-word' }, 'Pull me');
  const ring = element(
    'div',
    { class: 'invitation', 'aria-hidden': 'true' },
    element('span', { class: 'invitation-ring' }),
    word,
  );
  ring.hidden = true;
  ring.style.visibility = 'hidden'; // hidden until it has a place
  parent.append(ring);
  return {
    /** Pixels from the stage's upper left corner. */
    place(x: number, y: number) {
      ring.style.visibility = '';
      ring.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
      // The word stays inside the stage when the cloth is at its rim.
      const half = word.offsetWidth / 2 + 4;
      const inside = Math.min(parent.clientWidth - half, Math.max(half, x));
      word.style.left = `${(inside - x).toFixed(1)}px`;
    },
    setShown(isShown: boolean) {
      ring.hidden = !isShown;
    },
    /** Takes it away, for a stage without a picture. */
    remove: () => ring.remove(),
  };
}
