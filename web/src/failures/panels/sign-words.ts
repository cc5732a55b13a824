// The signs that a side shows, in words.
import { digits } from '../../shared/panels/quantity';
import { warningSentence } from '../../shared/panels/warning-words';
import { caseNamed, type Side, type Sign } from '../state/failure-cases';
import type { FailuresState } from '../state/failures-state';

const SIGN_TITLES: Record<Exclude<Sign, 'measured'>, string> = {
  stretch: 'stretched beyond its load',
  speed: 'too fast to be true',
  unsolved: 'equations left unsolved',
  not_converged: 'did not converge',
  given_up: 'a solver gave up',
  unbalanced: 'at rest out of balance',
  held_back: 'held back by the guard',
  blocked: 'pins stay behind',
  soft: 'stretched like a softer fabric',
  ended: 'numbers without end',
};

export interface ShownSign {
  sign: Sign;
  title: string;
  timeS: number;
  sentence: string;
}

/** The signs that a side shows by now, the first one first. */
export function signsOf({ caseId, sides }: FailuresState, side: Side): ShownSign[] {
  const { warnings, ended, measured } = sides[side];
  const { measure } = caseNamed(caseId);
  const signs = warnings.map(
    (warning): ShownSign => ({
      sign: warning.kind,
      title: SIGN_TITLES[warning.kind],
      timeS: warning.time_s,
      sentence: warningSentence(warning),
    }),
  );
  if (ended)
    signs.push({
      sign: 'ended',
      title: SIGN_TITLES.ended,
      timeS: ended.timeS,
      sentence: `The run ended at ${digits(ended.timeS, 2)} s: ${ended.sentence}. The last good frame stays.`,
    });
  if (measured && measure)
    signs.push({
      sign: 'measured',
      title: measure.title,
      timeS: measured.timeS,
      sentence: measure.sentence(measured.value),
    });
  return signs.sort((a, b) => a.timeS - b.timeS);
}

/** The sign that the case is about, once it is seen; until then the first one. */
export function mainSignOf(state: FailuresState, side: Side): ShownSign | undefined {
  const signs = signsOf(state, side);
  const { sign } = caseNamed(state.caseId);
  return signs.find((one) => one.sign === sign) ?? signs[0];
}

/** Sentence for a screen reader: a sign when it is first seen, empty once it is of what was shown before; null for neither. */
export function spokenSign(state: FailuresState, previous: FailuresState): string | null {
  const [now] = signsOf(state, 'naive');
  const [before] = signsOf(previous, 'naive');
  if (now && !before) return `Naive: ${now.title}. ${now.sentence}`;
  return before && !now ? '' : null;
}
