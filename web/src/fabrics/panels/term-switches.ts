// Switches for the form of the energy and for its terms, each with what that changes.
import { element, setText } from '../../shared/panels/element';
import { addSection } from '../../shared/panels/section';
import { type Store, watch } from '../../shared/state/store';
import { type DeformState, type EnergyForm, TERMS, type Term } from '../state/deform-state';
import { TERM_TITLES } from './term-words';
import { termKey } from './weight-bar';

export interface SwitchActions {
  setForm(form: EnergyForm): void;
  setTerms(terms: Record<Term, boolean>): void;
}

const FORMS: readonly { form: EnergyForm; title: string; meaning: string }[] = [
  {
    form: 'consistent',
    title: 'Consistent',
    meaning: 'Each term is summed over the area of the cloth: a fabric has one shape on any mesh.',
  },
  {
    form: 'published',
    title: 'Published',
    meaning:
      'Each term is summed over points and edges, as the paper prints it: with more triangles, or others, the same fabric takes another shape.',
  },
];

export const TERM_SENTENCES: Record<Term, { on: string; off: string }> = {
  recovery: {
    on: 'On: every point is drawn to where it lay.',
    off: 'Off: nothing draws a point to where it lay; pins and handles alone hold the cloth.',
  },
  stretch: {
    on: 'On: lengths resist change, so a pull reaches farther.',
    off: 'Off: lengths change at no cost, so a pulled handle stretches the cloth around it.',
  },
  bending: {
    on: 'On: the cloth resists bending, so folds are round.',
    off: 'Off: folds cost nothing, so they are as sharp as the triangles allow.',
  },
};

export const NOTHING_LEFT =
  'With all three off every shape would cost the same and none would be the answer: one stays on.';

/** The terms with that one switched; null when none would be left. */
export function switched(terms: Record<Term, boolean>, term: Term): Record<Term, boolean> | null {
  const changed = { ...terms, [term]: !terms[term] };
  return TERMS.some((one) => changed[one]) ? changed : null;
}

function formOption({ form, title, meaning }: (typeof FORMS)[number], choose: () => void) {
  const note = element('span', { class: 'note', id: `form-${form}` }, meaning);
  const input = element('input', {
    type: 'radio',
    name: 'energy-form',
    'aria-describedby': note.id,
    change: choose,
  });
  const line = element('div', { class: 'option' }, element('label', {}, input, title), note);
  return { form, input, line };
}

function termOption(term: Term, flip: () => void) {
  const note = element('span', { class: 'note', id: `term-${term}` });
  const input = element('input', {
    type: 'checkbox',
    'aria-describedby': note.id,
    change: flip,
  });
  const label = element('label', {}, input, termKey(term), TERM_TITLES[term]);
  return { term, input, note, line: element('div', { class: 'option' }, label, note) };
}

export function createTermSwitches(
  parent: HTMLElement,
  store: Store<DeformState>,
  { setForm, setTerms }: SwitchActions,
): void {
  const forms = FORMS.map((one) => formOption(one, () => setForm(one.form)));
  const refusal = element('p', { class: 'field-error', role: 'status' });
  const terms = TERMS.map((term) =>
    termOption(term, () => {
      const changed = switched(store.get().terms, term);
      setText(refusal, changed ? '' : NOTHING_LEFT);
      if (changed) setTerms(changed);
      else render(store.get());
    }),
  );

  function render(state: DeformState): void {
    for (const { form, input } of forms) input.checked = form === state.form;
    for (const { term, input, note } of terms) {
      input.checked = state.terms[term];
      setText(note, TERM_SENTENCES[term][state.terms[term] ? 'on' : 'off']);
    }
  }

  addSection(
    parent,
    'Energy',
    element(
      'fieldset',
      { class: 'field' },
      element('legend', {}, 'Form of the energy'),
      ...forms.map(({ line }) => line),
    ),
    element(
      'fieldset',
      { class: 'field' },
      element('legend', {}, 'Terms that count'),
      ...terms.map(({ line }) => line),
      refusal,
    ),
  );
  watch(store, ['form', 'terms'], render);
}
