// Three weights as a stacked bar, and as a sentence for those who do not see it.

import { element } from '../../shared/panels/element';
import { percent } from '../../shared/panels/quantity';
import type { TermNumbers } from '../bindings/deform-module';
import { TERMS } from '../state/deform-state';
import { TERM_TITLES } from './term-words';

export function createWeightBar() {
  const parts = TERMS.map((term) => element('span', { class: `term-${term}` }));
  return {
    bar: element('span', { class: 'weight-bar', 'aria-hidden': 'true' }, ...parts),
    show(weights: TermNumbers) {
      TERMS.forEach((term, index) => {
        const part = parts[index];
        if (part) part.style.flexGrow = String(weights[term]);
      });
    },
  };
}

/** "recovery 98 %, stretch 0.011 %, bending 1.7 %" */
export function weightWords(weights: TermNumbers): string {
  return TERMS.map((term) => `${TERM_TITLES[term].toLowerCase()} ${percent(weights[term])}`).join(
    ', ',
  );
}

/** A square in the term's colour. */
export function termKey(term: keyof TermNumbers): HTMLElement {
  return element('span', { class: `term-key term-${term}`, 'aria-hidden': 'true' });
}
