// Building the document by hand, briefly.

export type Attributes = Record<string, string | number | boolean | ((event: Event) => void)>;

/** An element with attributes (functions become listeners, false is left out) and children. */
export function element<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[Tag] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') made.addEventListener(name, value);
    else if (value !== false) made.setAttribute(name, value === true ? '' : String(value));
  }
  made.append(...children);
  return made;
}

/** An element of a drawing. */
export function svg(
  tag: string,
  attributes: Record<string, string | number>,
  text = '',
): SVGElement {
  const made = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  if (text) made.textContent = text;
  return made;
}

/** Sets the text only when it is another one, so that nothing is laid out or read anew. */
export function setText(target: Element, text: string): void {
  if (target.textContent !== text) target.textContent = text;
}

export function button(
  words: Node | string,
  click: () => void,
  attributes: Attributes = {},
): HTMLButtonElement {
  return element('button', { type: 'button', click, ...attributes }, words);
}

/** A box to tick, with its words behind it. */
export function checkBox(words: Node | string, onChange: (isOn: boolean) => void) {
  const input = element('input', { type: 'checkbox', change: () => onChange(input.checked) });
  return { input, label: element('label', { class: 'check' }, input, words) };
}

let nIds = 0;

/** A label above its control. */
export function field(
  label: string,
  control: HTMLElement,
  ...after: (Node | string)[]
): HTMLElement {
  nIds += 1;
  control.id ||= `control-${nIds}`;
  return element(
    'div',
    { class: 'field' },
    element('label', { for: control.id }, label),
    control,
    ...after,
  );
}

export interface Choice<Value> {
  control: HTMLSelectElement;
  select(value: Value): void;
  /** Disables the options for which there is a reason, and names it behind their titles. */
  limit(reason: (value: Value) => string | null): void;
}

/** A choice of named values. `onChoice` gets the chosen value. */
export function choice<Value extends string | number>(
  options: readonly { value: Value; title: string }[],
  onChoice: (value: Value) => void,
): Choice<Value> {
  const control = element('select', {
    change: () => {
      const chosen = options[control.selectedIndex];
      if (chosen) onChoice(chosen.value);
    },
  });
  for (const { title } of options) control.append(element('option', {}, title));
  return {
    control,
    select(value) {
      control.selectedIndex = options.findIndex((option) => option.value === value);
    },
    limit(reason) {
      options.forEach(({ value, title }, index) => {
        const why = reason(value);
        const option = control.options[index];
        if (!option) return;
        option.disabled = why !== null;
        setText(option, why === null ? title : `${title}: ${why}`);
      });
    },
  };
}
