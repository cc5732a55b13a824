// Time that a sweep is expected to take on this device, from what steps were measured to cost.
import { stepperRow } from '../../shared/steppers/steppers';
import { presetSetting, type Setting } from './setting';
import { type StepCosts, stepCostAt } from './step-cost';
import {
  durationS,
  FINEST_SHIPPED,
  FIRST_ROUND,
  methodsAt,
  REPEATS,
  type SweepWish,
  settingOf,
  sweptLevels,
  sweptSetting,
} from './sweep-plan';

/** Substeps that stand for as many as the stability bound asks for. */
const STABLE_SUBSTEPS = 100;

/** Time until the module is there and has its references [s]. */
const START_S = 1.5;

/** Rough cost of a step, in the same units for all steppers. */
function workOf({ stepper, substeps, iterations }: Setting): number {
  const { settings, substep_work } = stepperRow(stepper);
  const rounds = settings.iterations ? iterations : 1;
  return substep_work * rounds * (substeps === 0 ? STABLE_SUBSTEPS : substeps);
}

/**
 * Time of a step of a planned setting [ms], in proportion to the shown one where it was never run. The scenes have
 * meshes of about as many vertices at a level.
 */
function stepMs(costs: StepCosts, planned: Setting, shown: Setting): number | null {
  const own = stepCostAt(costs, planned, planned.level);
  if (own) return own.ms;
  const known = stepCostAt(costs, shown, planned.level);
  return known && (known.ms * workOf(planned)) / workOf(shown);
}

/** Exact motion on a setting's own mesh, in the steps of a reference and then in twice as long ones. */
const REFERENCE_STEPS_PER_S = 960 * 1.5;

/** The finest level whose own reference is shipped for the shown cloth; -1 for none. */
function finestShipped(setting: Setting): number {
  const own = presetSetting(setting.preset);
  const isOwn = (['fabric', 'model', 'meetsItself'] as const).every((p) => setting[p] === own[p]);
  return isOwn ? (FINEST_SHIPPED[setting.preset] ?? -1) : -1;
}

/** Every level's own reference, where none is shipped [ms]. */
function referencesMs(costs: StepCosts, shown: Setting, wish: SweepWish): number | null {
  const swept = sweptSetting(shown, wish);
  const exact = { ...swept, stepper: 'newton', stepS: 1 / 960, substeps: 1 };
  let sum = 0;
  const shipped = finestShipped(swept);
  for (const level of sweptLevels(swept, wish).filter((one) => one > shipped)) {
    const ms = stepMs(costs, { ...exact, level }, shown);
    if (ms === null) return null;
    sum += ms * REFERENCE_STEPS_PER_S * durationS(swept);
  }
  return sum;
}

/** Seconds for a sweep that is wished for; null while no step of the shown scene was timed. */
export function expectedSweepS(costs: StepCosts, shown: Setting, wish: SweepWish): number | null {
  const references = referencesMs(costs, shown, wish);
  if (references === null) return null;
  const swept = sweptSetting(shown, wish);
  let sum = references;
  for (const level of sweptLevels(swept, wish)) {
    for (const method of methodsAt(level, swept.model, wish.withSlow)) {
      const ms = stepMs(costs, settingOf({ level, method }, swept), shown);
      if (ms === null) return null;
      sum += (ms * durationS(swept) * (FIRST_ROUND + REPEATS)) / method.step_s;
    }
  }
  return START_S + sum / 1000;
}
