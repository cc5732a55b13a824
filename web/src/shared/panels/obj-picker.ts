// A button that asks for an OBJ file.
import { button, element } from './element';

/** A hidden picker of OBJ files, to be clicked; `label` names it. */
export function filePicker(label: string, open: (files: File[]) => void, multiple = false) {
  const picker = element('input', {
    type: 'file',
    accept: '.obj',
    multiple,
    hidden: true,
    'aria-label': label,
    change() {
      open([...(picker.files ?? [])]);
      picker.value = ''; // choosing the same file, mended, is a change again
    },
  });
  return picker;
}

export function createObjPicker(parent: HTMLElement, actions: { openObj(file: File): void }): void {
  const picker = filePicker('OBJ file', ([file]) => {
    if (file) actions.openObj(file);
  });
  parent.append(
    button('Choose an OBJ file', () => picker.click(), { class: 'wide' }),
    picker,
  );
}
