// The fabric file as the page reads it: names, values with source and confidence, meanings.
import fabricsText from '../../../../assets/fabrics/fabrics.json?raw';

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

/** Numbers that a scene has in place of a fabric's. */
export type OwnQuantities = Partial<Record<FabricQuantity, number>>;

export type FabricRecord = Record<FabricQuantity | 'bend_hysteresis_2hb_n', Measured> & {
  id: number;
  name_en: string;
  use_en: string;
  colour_en: string;
  assumed_construction: string;
  seed_table: GeometricRow;
};

/** A term as the fabric file's keys spell it. */
export type SpelledTerm = 'recovery' | 'stretch' | 'bend';

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

/** Twice the curvature at which a run turns friction inside bent cloth into rigidity [1/m] (kStaticBendCurvature). */
const TWICE_CURVATURE = 60;

/**
 * A quantity as a run takes it by default: at rest, friction between its yarns holds a fold as more rigidity
 * would. No fabric's friction is better known than its rigidity.
 */
export function inRun(fabric: FabricRecord, key: FabricQuantity): Measured {
  const own = fabric[key];
  if (!key.startsWith('bend')) return own;
  const { value, range, source, confidence } = fabric.bend_hysteresis_2hb_n;
  const sum = (slope: number, width: number) => slope + width / TWICE_CURVATURE;
  return {
    value: sum(own.value, value),
    range: [sum(own.range[0], range[0]), sum(own.range[1], range[1])],
    source: [...new Set([...own.source, ...source])],
    confidence,
  };
}
