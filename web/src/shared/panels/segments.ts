// A row of radio buttons that share one frame, of which one is pressed.
import { element } from './element';

export interface Segment<Value> {
  value: Value;
  title: string;
  /** Told where a pointer rests on it. */
  meaning?: string;
}

/** `onChoice` gets the pressed value. */
export function createSegments<Value extends string>(
  name: string,
  attributes: { class: string; 'aria-label': string },
  onChoice: (value: Value) => void,
  first: readonly Segment<Value>[] = [],
) {
  const control = element('div', { role: 'radiogroup', ...attributes });
  let options: { value: Value; input: HTMLInputElement }[] = [];
  function setOptions(segments: readonly Segment<Value>[]): void {
    control.replaceChildren();
    options = segments.map(({ value, title, meaning }) => {
      const input = element('input', { type: 'radio', name, change: () => onChoice(value) });
      const words = element('span', {}, title);
      control.append(element('label', { title: meaning ?? false }, input, words));
      return { value, input };
    });
  }
  setOptions(first);
  return {
    control,
    setOptions,
    select(value: Value) {
      for (const option of options) option.input.checked = option.value === value;
    },
  };
}
