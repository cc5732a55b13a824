// A button with a drawing and a word, for the row under a stage.
import { element, setText, svg } from './element';

/** Drawn on 16 by 16, so that no font has to know them. */
const ICONS = {
  play: 'M4 2.5V13.5L13.5 8Z',
  pause: 'M4 2.5H7V13.5H4ZM9 2.5H12V13.5H9Z',
  step: 'M3 2.5V13.5L10.5 8ZM11 2.5H13.5V13.5H11Z',
  reset: 'M8 2.5A5.5 5.5 0 1 1 2.9 6L4.7 6.7A3.6 3.6 0 1 0 8 4.4V7L3.6 3.5L8 0Z',
  link: 'M6.5 10.9L5.4 12A2.3 2.3 0 0 1 2.1 8.7L4.6 6.2A2.3 2.3 0 0 1 7.9 6.2L8.9 5.2A3.7 3.7 0 0 0 3.6 5.2L1.1 7.7A3.7 3.7 0 0 0 6.4 13L7.5 11.9ZM9.5 5.1L10.6 4A2.3 2.3 0 0 1 13.9 7.3L11.4 9.8A2.3 2.3 0 0 1 8.1 9.8L7.1 10.8A3.7 3.7 0 0 0 12.4 10.8L14.9 8.3A3.7 3.7 0 0 0 9.6 3L8.5 4.1Z',
  view: 'M8 1.5L15 8H13V14H9.5V10H6.5V14H3V8H1Z',
};

export function toolButton(
  icon: keyof typeof ICONS,
  text: string,
  title: string,
  onClick: () => void,
) {
  const made = element('button', { type: 'button', class: 'tool', title, click: onClick });
  const drawing = svg('svg', { viewBox: '0 0 16 16', 'aria-hidden': 'true' });
  const path = svg('path', {});
  drawing.append(path);
  const label = element('span', {}, text);
  made.append(drawing, label);
  const show = (newIcon: keyof typeof ICONS, newText: string) => {
    path.setAttribute('d', ICONS[newIcon]);
    setText(label, newText);
  };
  show(icon, text);
  return { made, show };
}
