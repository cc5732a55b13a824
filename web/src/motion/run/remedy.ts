// What helps a setting that was refused, or whose run shows nonsense.
import type { Failure } from '../../shared/bindings/answers';
import { type RunWarning, warningSentence } from '../../shared/bindings/run-warning';
import { stepperRow } from '../../shared/steppers/steppers';
import type { Remedy } from '../state/motion-state';
import { MOST_ITERATIONS, MOST_SUBSTEPS, type Setting, withStepper } from '../state/setting';

/** The sentence in place of the program's own, and what to do; null when it is not known what helps. */
export function remedyFor(
  failure: Failure,
  setting: Setting,
): { sentence: string; remedy: Remedy } | null {
  const { title, settings } = stepperRow(setting.stepper);
  if (failure.where !== '/method/substeps' || settings.substeps?.least !== 0) return null;
  const needed = /\((\d+) substeps would do\)/.exec(failure.what)?.[1];
  if (needed)
    return {
      sentence: `${title} tears this cloth apart with so few substeps: a step of it takes ${needed}.`,
      remedy: { title: 'Take as many as it needs', setting: { ...setting, substeps: 0 } },
    };
  return {
    sentence: `This cloth is too stiff for ${title}: no number of substeps that the page offers is enough.`,
    remedy: { title: 'Take Implicit', setting: withStepper(setting, 'implicit') },
  };
}

/** How a value that may help is set, and the words for it. */
const HINTS: Record<string, (value: number) => { title: string; change: Partial<Setting> }> = {
  '/method/substeps': (value) => ({
    title: `Take ${value} substeps`,
    change: { substeps: Math.min(value, MOST_SUBSTEPS) },
  }),
  '/method/iterations': (value) => ({
    title: `Take ${value} rounds`,
    change: { iterations: Math.min(value, MOST_ITERATIONS) },
  }),
};

/** The sentence for a run that shows what its scene cannot explain, and what may help. */
export function remedyForWarning(
  warning: RunWarning,
  setting: Setting,
): { sentence: string; remedy: Remedy } {
  const known = Object.entries(warning.hints).flatMap(
    ([pointer, value]) => HINTS[pointer]?.(Number(value)) ?? [],
  );
  const [first] = known;
  const remedy = first
    ? { title: first.title, setting: { ...setting, ...first.change } }
    : { title: 'Take Implicit', setting: withStepper(setting, 'implicit') };
  return { sentence: warningSentence(warning), remedy };
}
