// The table of steppers: whatever the page says of one, offers, measures or draws comes from its row.
import rows, { details } from 'virtual:pleat-steppers';

/** The elements that hold the cloth together. */
export type Model = 'springs' | 'membrane';

/** A scene's word for as many substeps as the stability bound asks for. */
export const STABLE_SUBSTEPS = 'stable';
export type Substeps = number | typeof STABLE_SUBSTEPS;

/** The number that fields and links of the page have for a count: 0 for as many as are stable. */
export function numberOf(count: Substeps): number {
  return count === STABLE_SUBSTEPS ? 0 : count;
}

export type Count = 'substeps' | 'iterations';

export type DetailValue = string | number;

/** A choice of a method beside its counts: one of some words, or a number between bounds. */
export interface MethodDetail {
  /** Spelled as in a scene and a link. */
  key: string;
  words?: readonly string[];
  least?: number;
  most?: number;
  /** It is of effect beside one of these words of other details; without it, always. */
  beside?: Readonly<Record<string, readonly string[]>>;
}

export interface StepperRow {
  /** Spelled as in a scene and a link. */
  name: string;
  title: string;
  meaning: string;
  /** It moves springs one by one and cannot run a membrane. */
  needs_springs: boolean;
  /** Each substep has equations, which may be left unsolved in part. */
  solves: boolean;
  /** The counts the stepper reads, each with what it starts from. */
  settings: Partial<Record<Count, { start: Substeps; least: Substeps; meaning: string }>>;
  /** Values that the details that it reads start from. */
  details: Readonly<Record<string, DetailValue>>;
  /** The counts with which a sweep measures it at every level. */
  sweep: readonly { substeps?: Substeps; iterations?: number }[];
  /** Each substep is one system of all vertices. */
  solves_whole_substeps: boolean;
  /** Rough cost of a substep of one iteration, in the same units for all steppers. */
  substep_work: number;
  /** The models whose sweeps it takes part in. */
  models: readonly Model[];
  /** Finest level at which a sweep takes it in. */
  finest_sweep_level?: number;
  /** Its mark in a chart: an SVG path about the origin. */
  mark: string;
  colour: string;
  dark_colour: string;
}

export const STEPPERS = rows as readonly StepperRow[];
export const METHOD_DETAILS = details as readonly MethodDetail[];
export const STEPPER_NAMES: readonly string[] = STEPPERS.map(({ name }) => name);

/** The row of a stepper that is in the table. */
export function stepperRow(name: string): StepperRow {
  const found = STEPPERS.find((row) => row.name === name);
  if (!found) throw new Error(`no stepper is called ${name}`);
  return found;
}

export function canRun(name: string, model: Model): boolean {
  return model === 'springs' || !stepperRow(name).needs_springs;
}
