// A file that is being read, and the way out of it.
import { button, element, setText } from './element';

export function createReading(cancel: () => void) {
  const what = element('p', { class: 'note', role: 'status' });
  const box = element(
    'div',
    { class: 'reading' },
    what,
    element('progress', { 'aria-label': 'Reading the file' }),
    button('Cancel', cancel, { class: 'wide' }),
  );
  return {
    box,
    /** Null hides it. */
    show(name: string | null) {
      box.hidden = name === null;
      setText(what, name === null ? '' : `Reading ${name}`);
    },
  };
}
