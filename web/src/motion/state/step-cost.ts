// Cost of a step on this device at each level: as measured, or as expected from another level.
import { shortTime } from '../../shared/panels/quantity';
import {
  STABLE_SUBSTEPS,
  type StepperRow,
  type Substeps,
  stepperRow,
} from '../../shared/steppers/steppers';
import { COUNTS, type Setting, wantedShare, withLevel } from './setting';

export interface StepCost {
  ms: number;
  /** A step was measured at that level; else it follows from another one, or from some of its substeps. */
  isMeasured: boolean;
  /** The step was stopped then: it takes longer. */
  isLeast: boolean;
}

/** Costs that are known, by `keyOf` a setting. */
export type StepCosts = Readonly<Record<string, StepCost>>;

/** Substeps whose step may take longer than anybody waits: it is foretold. */
export const MANY_SUBSTEPS = 100;

/** Each level has four times the vertices. */
const WORK_PER_LEVEL = 4;
/** And asks for four times the substeps, where they are as many as the stability bound wants. */
const STABLE_WORK_PER_LEVEL = 16;
/**
 * A system of all vertices takes longer still: measured at levels 0 to 3 of all scenes, 4 to 6 times at first, and
 * then 5 to 8, exact ones up to 19.
 */
const SOLVED_WORK_PER_LEVEL = 7;

/** Work of a step on a mesh over that on one a level coarser. */
export function growthOf({ solves_whole_substeps }: StepperRow, substeps?: Substeps): number {
  if (substeps === 0 || substeps === STABLE_SUBSTEPS) return STABLE_WORK_PER_LEVEL;
  return solves_whole_substeps ? SOLVED_WORK_PER_LEVEL : WORK_PER_LEVEL;
}

/** So many levels finer than what was measured, an estimate is a bound: solves grow faster and faster. */
const LEVELS_TO_BOUND = 2;

/** The key of a cost: what it depends on, beside the fabric, which matters little. */
function keyOf(setting: Setting): string {
  const { preset, model, stepper, stepS, level, knit, meetsItself } = setting;
  const { settings } = stepperRow(stepper);
  const counts = COUNTS.filter((count) => settings[count]).map((count) => setting[count]);
  const particles = knit ? [knit.columns * knit.rows] : [];
  const share = wantedShare(setting);
  const details = Object.entries(setting.details ?? {}).flat();
  if (meetsItself) details.push('meets itself');
  const steps = [Math.round(1 / stepS), ...counts, share, ...details];
  return [preset, ...particles, model, stepper, ...steps, level].join(' ');
}

export function withCost(
  costs: StepCosts,
  setting: Setting,
  ms: number,
  how: Partial<StepCost> = {},
): StepCosts {
  return { ...costs, [keyOf(setting)]: { ms, isMeasured: true, isLeast: false, ...how } };
}

/** Cost that a step of this setting would have at a level; null while nothing like it was measured. */
export function stepCostAt(costs: StepCosts, setting: Setting, level: number): StepCost | null {
  const at = (other: number) => withLevel(setting, other);
  const measuredAt = (other: number) => costs[keyOf(at(other))];
  const own = measuredAt(level);
  if (own) return own;
  const growth = growthOf(stepperRow(setting.stepper), setting.substeps);
  const substepsOver = (other: number) => at(level).substeps / at(other).substeps || 1;
  // The nearest level tells best; of two that are as near, the finer one.
  for (const away of [1, -1, 2, -2, 3, -3, 4, -4]) {
    const known = measuredAt(level + away);
    if (!known || (known.isLeast && away > 0)) continue; // a coarser level may be quick
    const isLeast = known.isLeast || away <= -LEVELS_TO_BOUND;
    const ms = known.ms * growth ** -away * substepsOver(level + away);
    return { ms, isMeasured: false, isLeast };
  }
  return null;
}

/** A cost where there is little room: "13 ms", "≈ 5 s", "> 9 s". */
export function costText({ ms, isMeasured, isLeast }: StepCost): string {
  if (isLeast) return `> ${shortTime(ms)}`;
  return isMeasured ? shortTime(ms) : `≈ ${shortTime(ms, 1)}`;
}
