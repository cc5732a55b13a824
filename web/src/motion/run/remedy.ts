// What helps a setting that was refused.
import type { Failure } from '../../shared/bindings/answers';
import { stepperRow } from '../../shared/steppers/steppers';
import type { Remedy } from '../state/motion-state';
import { type Setting, withStepper } from '../state/setting';

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
