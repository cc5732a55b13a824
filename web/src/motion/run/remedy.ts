// Help for a setting that was refused.
import type { Failure } from '../../shared/bindings/answers';
import { STABLE_SUBSTEPS, stepperRow } from '../../shared/steppers/steppers';
import { KNIT_PLACES, knitTitle, unitOf } from '../state/knit';
import type { Remedy } from '../state/motion-state';
import { presetSetting, type Setting, withStepper } from '../state/setting';

interface Help {
  sentence: string;
  remedy: Remedy;
}

/** Help for a number of a knit that its reader refuses: that of the preset. */
function remedyForKnit({ where, what }: Failure, setting: Setting): Help | null {
  const { knit } = setting;
  const { knit: own } = presetSetting(setting.preset);
  if (!knit || !own || !where.startsWith('/cloth/knit')) return null;
  const place = KNIT_PLACES.find((one) => where === `/cloth/knit/${one}`);
  if (!place) {
    const remedy = { title: 'Take the knit as it was', setting: { ...setting, knit: own } };
    return { sentence: `The knit: ${what}.`, remedy };
  }
  const { form, scene } = unitOf(place, knit.dampingPer);
  return {
    sentence: `${knitTitle(place)}: ${`${what} ${scene}`.trimEnd()}.`,
    remedy: {
      title: `Take ${own[place]} ${form}`.trimEnd(),
      setting: { ...setting, knit: { ...knit, [place]: own[place] } },
    },
  };
}

/** The sentence in place of the program's own, and what to do; null when it is not known what helps. */
export function remedyFor(failure: Failure, setting: Setting): Help | null {
  const { title, settings } = stepperRow(setting.stepper);
  if (failure.where !== '/method/substeps') return remedyForKnit(failure, setting);
  if (settings.substeps?.least !== STABLE_SUBSTEPS) return null;
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
