// Measurements of the shapes that each fabric takes, and the weights that follow from it.

import { type FabricRecord, fabrics, type SpelledTerm } from '../../shared/fabric/fabric-data';
import { TERMS, type Term } from './deform-state';

export function perTerm<Value>(of: (term: Term) => Value): Record<Term, Value> {
  return { recovery: of('recovery'), stretch: of('stretch'), bending: of('bending') };
}

const SPELLED: Record<Term, SpelledTerm> = {
  recovery: 'recovery',
  stretch: 'stretch',
  bending: 'bend',
};

export function geometryOf({ seed_table: row }: FabricRecord) {
  const normalised = perTerm((term) => row[`vn_${SPELLED[term]}`]);
  const sum = TERMS.reduce((total, term) => total + normalised[term], 0);
  return {
    /** Ratios, v. */
    measures: perTerm((term) => row[`v_${SPELLED[term]}`]),
    /** v', within [0, 1]. */
    normalised,
    /** The shares of v': what the source means. They add up to one. */
    recomputed: perTerm((term) => normalised[term] / sum),
    /** The source's weights as printed, with its slips. */
    published: perTerm((term) => row[`weight_${SPELLED[term]}_percent`] / 100),
  };
}

/** Least and largest of the fabrics' measures of that term. */
export function measuredRange(term: Term): [number, number] {
  const values = fabrics.map((fabric) => geometryOf(fabric).measures[term]);
  return [Math.min(...values), Math.max(...values)];
}

/** RMS by which the other fabrics' mean misses a fabric's normalised measure. */
export function errorOfMean(term: Term): number {
  const values = fabrics.map((fabric) => geometryOf(fabric).normalised[term]);
  const n = values.length;
  const mean = values.reduce((sum, value) => sum + value, 0) / n;
  const squares = values.reduce((sum, value) => sum + (value - mean) ** 2, 0);
  return (n / (n - 1)) * Math.sqrt(squares / n);
}
