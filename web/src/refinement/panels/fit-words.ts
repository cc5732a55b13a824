// The words of the light that tells whether the shown motion is of the examples' kind.
import { percent } from '../../shared/panels/quantity';
import type { Fit } from '../state/fit';
import { EXAMPLE_FRAMES, FRAMES_TO_FIRE, LARGEST_SHARE } from '../state/garment-frames';
import { MOTIONS, type MotionId, usualFabric } from '../state/garments';
import type { PlanStory } from '../state/plan-file';
import {
  canPlanAnew,
  isExample,
  type RefinementLink,
  type RefinementState,
} from '../state/refinement-state';
import { vertices } from './garment-words';

/** Frames of a second: before that a motion that fits and one that does not look alike. */
export const FRAMES_TO_FIT = 30;

export interface FitReading {
  light: 'fits' | 'uneasy' | 'fires' | 'watching' | 'unknown';
  title: string;
  detail: string;
}

/** "Fast walk" → "fast walk". */
function motionName(motion: MotionId): string {
  return (MOTIONS.find(({ value }) => value === motion)?.title ?? motion).toLowerCase();
}

type Shown = Pick<RefinementLink, 'garment' | 'motion' | 'fabric' | 'further'>;

type Run = Pick<Shown, 'motion' | 'fabric'>;

/** Says what the plan is made of, and that this is it, or in what it differs: motion, fabric or both. */
export function exampleSentence({ garment, motion, fabric, further }: Shown): string {
  const examples: Run[] = [
    { motion: MOTIONS[0].value, fabric: usualFabric(garment) },
    ...further.map((own) => ({ motion: own, fabric })),
  ];
  const isSole = examples.length === 1;
  const areOfFabric = examples.map((own) => own.fabric === fabric);
  const areOfMotion = examples.map((own) => own.motion === motion);
  if (examples.some((_, index) => areOfFabric[index] && areOfMotion[index]))
    return `This is ${isSole ? 'the example' : 'one of the examples'}.`;
  const isOneFabric = areOfFabric.every((isSame) => isSame);
  const isOneMotion = areOfMotion.every((isSame) => isSame);
  const nameOf = (run: Run) => {
    if (isOneMotion) return `in ${run.fabric}`;
    return `the ${motionName(run.motion)}${isOneFabric ? '' : ` in ${run.fabric}`}`;
  };
  const list = new Intl.ListFormat('en-GB').format(examples.map(nameOf));
  const these = isSole ? 'The example is' : 'The examples are';
  return `${these} ${list}; this is ${nameOf({ motion, fabric })}.`;
}

/** The rule by which it is decided. */
export function ruleSentence(story: PlanStory | null): string {
  const examples = story && story.examples.length > 1 ? 'examples' : 'example';
  return `The rule: it does not fit once more than ${percent(LARGEST_SHARE)} of the faces bend more than those near them did in the ${examples}, for ${FRAMES_TO_FIRE} frames in a row (1/3 s). A single bad frame decides nothing.`;
}

/** The monitor's light. */
export function fitReading(fit: Fit | null, story: PlanStory | null, shown: Shown): FitReading {
  if (!fit || !story?.hasLimits)
    return {
      light: 'unknown',
      title: 'Not watched yet',
      detail: 'Each frame is compared with the example once the cloth moves.',
    };
  const examples = story.examples.length > 1 ? 'examples' : 'example';
  const example = exampleSentence(shown);
  const limit = percent(LARGEST_SHARE);
  const lasting = `${percent(fit.lasting_share)} of the faces bent too far for ${FRAMES_TO_FIRE} frames in a row`;
  if (fit.first_fired !== null)
    return {
      light: 'fires',
      title: `Does not fit the ${examples}`,
      detail: `${example} Up to ${lasting}, more than the ${limit} allowed.`,
    };
  if (fit.n_frames < FRAMES_TO_FIT)
    return {
      light: 'watching',
      title: 'Watching',
      detail: `${example} ${fit.n_frames} of ${FRAMES_TO_FIT} frames seen: too few to tell.`,
    };
  if (fit.share > LARGEST_SHARE)
    return {
      light: 'uneasy',
      title: 'Fits so far',
      detail: `${example} ${percent(fit.share)} of the faces bend too far now, for ${fit.n_in_a_row} of ${FRAMES_TO_FIRE} frames; ${limit} are allowed.`,
    };
  return {
    light: 'fits',
    title: `Fits the ${examples}`,
    detail: `${example} At most ${lasting}; ${limit} are allowed.`,
  };
}

/** Says below the button that plans anew what it does, or why it does nothing now. */
export function anewSentence(state: RefinementState): string {
  if (canPlanAnew(state))
    return `Runs it once on the fine mesh first: ${EXAMPLE_FRAMES} frames of ${vertices(state.panes.fine.nVertices)}.`;
  if (isExample(state)) return 'The plan is made of this motion already.';
  return 'For a motion that does not fit, once the light says so.';
}
