// The three terms of the energy in words.
import type { Term } from '../state/deform-state';

export const TERM_TITLES: Record<Term, string> = {
  recovery: 'Recovery',
  stretch: 'Stretch',
  bending: 'Bending',
};

/** Treatment of a sample of 46 x 40 cm, twenty times. */
export const TERM_MEASUREMENTS: Record<Term, string> = {
  recovery: 'Crumpled and let go: the area it then covers, over the area it had.',
  stretch: 'Pulled at a corner with 4 to 8 newtons: its diagonal, over the diagonal at rest.',
  bending: 'Pushed into wrinkles: their mean height, over the height of the highest.',
};

/** Deformation that a shape pays for, and so avoids. */
export const TERM_COSTS: Record<Term, string> = {
  recovery: 'distance from where it lay',
  stretch: 'change of length',
  bending: 'change of bend',
};
