// Choices of a method beside its counts, as the core's table tells it.
import details from 'virtual:pleat-details';
import { button, choice, element, field } from '../../../shared/panels/element';
import { folded } from '../../../shared/panels/section';
import { type Store, watch } from '../../../shared/state/store';
import { type DetailValue, stepperRow } from '../../../shared/steppers/steppers';
import type { MotionState } from '../../state/motion-state';
import { detailOf, isRead, type Setting, withDetail, withStepper } from '../../state/setting';

interface Detail {
  key: string;
  title: string;
  meaning: string;
  words?: readonly { value: string; title: string }[];
  least?: number;
  most?: number;
  step?: number;
}

type Choose = (value: DetailValue | undefined) => void;

/** A number; an empty field is what the stepper usually has. */
function numberControl({ least = 0, most = 0, step = 1 }: Detail, choose: Choose) {
  const control = element('input', {
    type: 'number',
    min: least,
    max: most,
    step,
    placeholder: 'usual',
    inputmode: 'decimal',
    change() {
      const { value } = control;
      const number = step === 1 ? Math.round(Number(value)) : Number(value);
      choose(value === '' ? undefined : Math.min(most, Math.max(least, number)));
    },
  });
  const select = (value: DetailValue) => {
    control.value = typeof value === 'number' ? String(value) : '';
  };
  return { control, select };
}

function detailField(detail: Detail, choose: Choose) {
  const { key, title, meaning, words } = detail;
  const { control, select } = words ? choice(words, choose) : numberControl(detail, choose);
  const note = element('span', { class: 'note', id: `detail-${key}` }, meaning);
  control.setAttribute('aria-describedby', note.id);
  const box = field(title, control, note);
  return {
    box,
    show(setting: Setting) {
      box.hidden = !isRead(setting, key);
      const value = detailOf(setting, key);
      if (value !== undefined) (select as (value: DetailValue) => void)(value);
    },
  };
}

export function createMethodDetails(parent: HTMLElement, store: Store<MotionState>): void {
  const fields = (details as readonly Detail[]).map((detail) =>
    detailField(detail, (value) =>
      store.set({ setting: withDetail(store.get().setting, detail.key, value) }),
    ),
  );
  const usual = button(
    'As usual',
    () => {
      const { setting } = store.get();
      const { details: own } = withStepper(setting, setting.stepper);
      store.set({ setting: { ...setting, details: own } });
    },
    { class: 'wide' },
  );
  const box = folded(
    'More of this method',
    { class: 'method-details' },
    ...fields.map((one) => one.box),
    usual,
  );
  box.open = store.get().setting.details !== undefined;
  parent.append(box);
  watch(store, ['setting'], ({ setting }) => {
    box.hidden = Object.keys(stepperRow(setting.stepper).details).length === 0;
    for (const one of fields) one.show(setting);
  });
}
