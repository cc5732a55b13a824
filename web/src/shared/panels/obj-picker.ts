// A button that asks for an OBJ file.
import { button, element } from './element';

export function createObjPicker(parent: HTMLElement, actions: { openObj(file: File): void }): void {
  const picker = element('input', {
    type: 'file',
    accept: '.obj',
    hidden: true,
    'aria-label': 'OBJ file',
    change() {
      const [file] = picker.files ?? [];
      if (file) actions.openObj(file);
      picker.value = ''; // choosing the same file, mended, is a change again
    },
  });
  parent.append(
    button('Choose an OBJ file', () => picker.click(), { class: 'wide' }),
    picker,
  );
}
