// The fabric file as the page reads it: names, values with source and confidence, meanings.
import fabricsText from '../../../../assets/fabrics/fabrics.json?raw';
import { TERMS, type Term, type Triple } from '../../fabrics/state/deform-state';

export type Confidence = 'measured' | 'typical' | 'estimated';

export interface Measured {
  value: number;
  range: [number, number];
  /** Keys of `sources`. */
  source: string[];
  confidence: Confidence;
}

/** The measured quantities, by key of the file; each key carries its unit. */
export type FabricQuantity =
  | 'areal_density_kg_per_m2'
  | 'thickness_m'
  | 'stretch_warp_n_per_m'
  | 'stretch_weft_n_per_m'
  | 'shear_n_per_m'
  | 'bend_warp_n_m'
  | 'bend_weft_n_m'
  | 'damping_ratio'
  | 'friction_fabric_solid';

export type FabricRecord = Record<FabricQuantity, Measured> & {
  id: number;
  name_en: string;
  use_en: string;
  colour_en: string;
  assumed_construction: string;
  seed_table: GeometricRow;
};

/** A term as the fabric file's keys spell it. */
type SpelledTerm = 'recovery' | 'stretch' | 'bend';

type GeometricRow = { source: string[] } & Record<
  `v_${SpelledTerm}` | `vn_${SpelledTerm}` | `weight_${SpelledTerm}_percent`,
  number
>;

interface FabricFile {
  meta: { sources: Record<string, string>; confidence: Record<Confidence, string> };
  fabrics: FabricRecord[];
}

const file = JSON.parse(fabricsText) as FabricFile;

export const fabrics: readonly FabricRecord[] = file.fabrics;
export const sources: Readonly<Record<string, string>> = file.meta.sources;
export const confidenceMeaning: Readonly<Record<Confidence, string>> = file.meta.confidence;

/** The file's text, as the module wants it. */
export { fabricsText };

/** The fabric of that name; the first one when the name is unknown. */
export function fabricNamed(name: string): FabricRecord {
  const found = fabrics.find((fabric) => fabric.name_en === name) ?? fabrics[0];
  if (!found) throw new Error('the fabric file holds no fabric');
  return found;
}

/** What was measured of a fabric's shape, and what it weighs in a deformed one. */
export interface FabricGeometry {
  /** Ratios, v. */
  measures: Triple;
  /** v', within [0, 1]. */
  normalised: Triple;
  /** The shares of v': what the source means. They add up to one. */
  recomputed: Triple;
  /** The source's weights as printed, with its slips. */
  published: Triple;
}

export function triple(of: (term: Term) => number): Triple {
  return { recovery: of('recovery'), stretch: of('stretch'), bending: of('bending') };
}

const SPELLED: Record<Term, SpelledTerm> = {
  recovery: 'recovery',
  stretch: 'stretch',
  bending: 'bend',
};

export function geometryOf({ seed_table: row }: FabricRecord): FabricGeometry {
  const normalised = triple((term) => row[`vn_${SPELLED[term]}`]);
  const sum = TERMS.reduce((total, term) => total + normalised[term], 0);
  return {
    measures: triple((term) => row[`v_${SPELLED[term]}`]),
    normalised,
    recomputed: triple((term) => normalised[term] / sum),
    published: triple((term) => row[`weight_${SPELLED[term]}_percent`] / 100),
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
