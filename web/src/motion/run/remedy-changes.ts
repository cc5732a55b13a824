// Changes of a setting that may help its run: the counts that its stepper starts with, those that a warning
// hints at, more of the same, and a calm method.
import type { RunWarning } from '../../shared/bindings/run-warning';
import { type Count, STABLE_SUBSTEPS, stepperRow } from '../../shared/steppers/steppers';
import {
  COUNTS,
  isSameMethod,
  MOST_ITERATIONS,
  MOST_SUBSTEPS,
  type Setting,
  STEPS_PER_SECOND,
  withStepper,
} from '../state/setting';

export interface Change {
  setting: Setting;
  /** The change in words: "16 substeps". */
  what: string;
  /** Why the run needed it, to be told once it is known to help. */
  why: string;
}

/** Counts beyond those that are hinted at are so many times as large. */
const FURTHER = 4;

/** Longer steps fold cloth as no cloth does [s]. */
const FRAME_S = 1 / 60;

const MOST: Record<Count, number> = { substeps: MOST_SUBSTEPS, iterations: MOST_ITERATIONS };

/** Hints have a tolerance where steps are fractions of a second that went through text. */
const HAIR = 1e-9;

const timesText = (times: number) => `${Number(times.toPrecision(2))} times as`;

const whyOften = (times: number) =>
  `The computer looks too rarely: ${timesText(times)} often would do.`;

const WHY: Record<Count, (times: number) => string> = {
  substeps: whyOften,
  iterations: (times) =>
    `The computer tries too few times in each step: ${timesText(times)} many would do.`,
};

/** The counts that the stepper starts with on such a mesh, where they are more. */
function withStart(setting: Setting): Change | null {
  const start = withStepper(setting, setting.stepper);
  const more = COUNTS.filter((count) => start[count] > setting[count] && setting[count] > 0);
  const [first] = more;
  if (!first) return null;
  return {
    setting: { ...setting, ...Object.fromEntries(more.map((count) => [count, start[count]])) },
    what: more.map((count) => `${start[count]} ${count}`).join(' and '),
    why: WHY[first](start[first] / setting[first]),
  };
}

function withCount(setting: Setting, count: Count, wanted: number): Change | null {
  const value = Math.min(wanted, MOST[count]);
  if (!(value > setting[count]) || !stepperRow(setting.stepper).settings[count]) return null;
  const why = WHY[count](value / setting[count]);
  return { setting: { ...setting, [count]: value }, what: `${value} ${count}`, why };
}

function withMethod(setting: Setting, stepper: string, stepS: number, substeps: number): Change {
  const { title } = stepperRow(stepper);
  return {
    setting: { ...withStepper(setting, stepper), stepS, substeps },
    what: `${title} in ${substeps} substeps`,
    why:
      stepper === setting.stepper
        ? `${title} holds this cloth together in shorter substeps.`
        : `${stepperRow(setting.stepper).title} does not hold this cloth together; ${title} does.`,
  };
}

/** The longest step that the page offers and that is no longer than that. */
function withStep(setting: Setting, longestS: number): Change | null {
  const perSecond = STEPS_PER_SECOND.find((count) => 1 / count <= longestS + HAIR);
  if (!perSecond || 1 / perSecond >= setting.stepS - HAIR) return null;
  const why = whyOften(setting.stepS * perSecond);
  return { setting: { ...setting, stepS: 1 / perSecond }, what: `steps of 1/${perSecond} s`, why };
}

/** Takes as many substeps as the stability bound asks for. */
function withStableSubsteps(setting: Setting): Change {
  return {
    setting: { ...setting, substeps: 0 },
    what: 'as many substeps as are stable',
    why: 'Its substeps are longer than so stiff a cloth bears.',
  };
}

/** A value that the core hints at, by its place in the scene; null where the page cannot set it. */
function hinted(setting: Setting, pointer: string, value: unknown): Change | null {
  if (pointer === '/method/substeps' && value === STABLE_SUBSTEPS)
    return withStableSubsteps(setting);
  if (pointer === '/method/substeps') return withCount(setting, 'substeps', Number(value));
  if (pointer === '/method/iterations') return withCount(setting, 'iterations', Number(value));
  if (pointer === '/method/step_s') return withStep(setting, Number(value));
  if (pointer !== '/method') return null;
  const { stepper, step_s, substeps } = value as {
    stepper: string;
    step_s: number;
    substeps: number;
  };
  return withMethod(setting, stepper, step_s, substeps);
}

/** More of the first count that is hinted at, and a method that comes to rest on any mesh. */
function further(hints: RunWarning['hints'], setting: Setting): (Change | null)[] {
  const more = (['substeps', 'iterations'] as const).map((count) => {
    const value = Number(hints[`/method/${count}`]);
    return value > 0 ? withCount(setting, count, FURTHER * value) : null;
  });
  const calm = withMethod(setting, 'implicit', Math.min(setting.stepS, FRAME_S), 4);
  return [...more, calm];
}

/** Changes in the order in which they are worth a try, each one alone and none twice. */
export function changesFor({ hints }: Pick<RunWarning, 'hints'>, setting: Setting): Change[] {
  const known = Object.entries(hints).map(([pointer, value]) => hinted(setting, pointer, value));
  const all = [withStart(setting), ...known, ...further(hints, setting)];
  const changes = all.filter((change) => change !== null);
  return changes.filter(
    (change, index) =>
      !isSameMethod(change.setting, setting) &&
      !changes.slice(0, index).some((other) => isSameMethod(other.setting, change.setting)),
  );
}
