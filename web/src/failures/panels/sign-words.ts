// The signs that a side shows, in words.
import { digits } from '../../shared/panels/quantity';
import { warningSentence } from '../../shared/panels/warning-words';
import type { Sign } from '../state/failure-cases';
import type { SideState } from '../state/failures-state';

export const SIGN_TITLES: Record<Sign, string> = {
  stretch: 'stretched beyond its load',
  speed: 'too fast to be true',
  unsolved: 'equations left unsolved',
  not_converged: 'did not converge',
  given_up: 'a solver gave up',
  unbalanced: 'at rest out of balance',
  soft: 'stretched like a softer fabric',
  ended: 'numbers without end',
};

export interface ShownSign {
  sign: Sign;
  timeS: number;
  sentence: string;
}

/** The signs that a side shows by now, the first one first. */
export function signsOf({ warnings, ended }: SideState): ShownSign[] {
  const signs = warnings.map(
    (warning): ShownSign => ({
      sign: warning.kind,
      timeS: warning.time_s,
      sentence: warningSentence(warning),
    }),
  );
  if (ended)
    signs.push({
      sign: 'ended',
      timeS: ended.timeS,
      sentence: `The run ended at ${digits(ended.timeS, 2)} s: ${ended.sentence}. The last good frame stays.`,
    });
  return signs.sort((a, b) => a.timeS - b.timeS);
}
