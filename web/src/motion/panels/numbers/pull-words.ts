// Words on what a hand asks of the cloth.
import { digits } from '../../../shared/panels/quantity';
import type { MotionState } from '../../state/motion-state';

/** Length of woven cloth over that at rest that it bears; the core's hand gives it no more (kHandStretch). */
const BORNE = 1.1;

/** The sentence while a hand pulls further than the cloth goes; else null. */
export function pullSentence({
  held,
  numbers,
}: Pick<MotionState, 'held' | 'numbers'>): string | null {
  const asked = numbers?.asked_stretch ?? 0;
  if (!held || asked < BORNE) return null;
  const times = digits(asked, 2);
  return `You pull it to ${times} times its length; woven cloth tears at about ${BORNE}, so the hand gives way.`;
}
