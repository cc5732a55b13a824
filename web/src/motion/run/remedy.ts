// Help for a setting that was refused, or whose run shows nonsense.
import type { Failure } from '../../shared/bindings/answers';
import type { RunWarning } from '../../shared/bindings/run-warning';
import { warningSentence } from '../../shared/panels/warning-words';
import { STABLE_SUBSTEPS, stepperRow } from '../../shared/steppers/steppers';
import { KNIT_PLACES, knitTitle, unitOf } from '../state/knit';
import type { Remedy } from '../state/motion-state';
import {
  MOST_ITERATIONS,
  MOST_SUBSTEPS,
  presetSetting,
  type Setting,
  withStepper,
} from '../state/setting';

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

interface Change {
  why: string;
  title: string;
  change: Partial<Setting>;
}

/** A count as far as the page goes, why more of it may help, and the words for it. */
const countHint =
  (count: 'substeps' | 'iterations', most: number, why: string) =>
  (value: unknown): Change => {
    const more = Math.min(Number(value), most);
    return { why, title: `Start again with ${more} ${count}`, change: { [count]: more } };
  };

/** How a value that may help is set, why, and the words for it. */
const HINTS: Record<string, (value: unknown, setting: Setting) => Change> = {
  '/method/substeps': countHint('substeps', MOST_SUBSTEPS, 'The computer looks too rarely.'),
  '/method/iterations': countHint(
    'iterations',
    MOST_ITERATIONS,
    'The computer tries too few times in each step.',
  ),
  '/method': (value, setting) => {
    const { stepper, step_s, substeps } = value as {
      stepper: string;
      step_s: number;
      substeps: number;
    };
    return {
      why: 'It carries a pull too slowly over so fine a mesh.',
      title: `Start again with ${stepperRow(stepper).title} in ${substeps} substeps`,
      change: { ...withStepper(setting, stepper), stepS: step_s, substeps },
    };
  },
};

/** The sentence for a run that shows what its scene cannot explain, and what may help: from the start, not from the wreck. */
export function remedyForWarning(warning: RunWarning, setting: Setting): Help {
  const known = Object.entries(warning.hints).flatMap(
    ([pointer, value]) => HINTS[pointer]?.(value, setting) ?? [],
  );
  const helps = known.find(({ change }) => !isSame(change, setting));
  const sentence = warningSentence(warning);
  if (!helps)
    return {
      sentence,
      remedy: {
        title: 'Start again with Implicit',
        setting: withStepper(setting, 'implicit'),
        startsAnew: true,
      },
    };
  const { why, title, change } = helps;
  return {
    sentence: warning.is_nonsense ? `${sentence} ${why}` : sentence,
    remedy: { title, setting: { ...setting, ...change }, startsAnew: true },
  };
}

/** True where a change is none: what may help is at its most already. */
function isSame(change: Partial<Setting>, { stepper, substeps, iterations }: Setting): boolean {
  return (
    (change.stepper ?? stepper) === stepper &&
    (change.substeps ?? substeps) === substeps &&
    (change.iterations ?? iterations) === iterations
  );
}
