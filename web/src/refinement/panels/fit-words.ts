// The words of the light that tells whether the shown motion is of the examples' kind.
import { percent } from '../../shared/panels/quantity';
import type { Fit } from '../state/fit';
import { FRAMES_TO_FIRE, LARGEST_SHARE } from '../state/garment-frames';
import { MOTIONS, type MotionId, usualFabric } from '../state/garments';
import type { PlanStory } from '../state/plan-file';
import {
  canPlanAnew,
  isExample,
  type RefinementLink,
  type RefinementState,
} from '../state/refinement-state';

/** Frames of a second: before that a motion that fits and one that does not look alike. */
export const FRAMES_TO_FIT = 30;

export interface FitReading {
  light: 'fits' | 'uneasy' | 'fires' | 'watching' | 'unknown';
  title: string;
  detail: string;
}

/** "Fast walk: like the example" → "fast walk". */
function motionName(motion: MotionId): string {
  const title = MOTIONS.find(({ value }) => value === motion)?.title ?? motion;
  return (title.split(':')[0] ?? title).toLowerCase();
}

type Shown = Pick<RefinementLink, 'garment' | 'motion' | 'fabric' | 'further'>;

/** Says in what the shown run differs from those that the plan is made of. */
export function changeSentence({ garment, motion, fabric, further }: Shown): string {
  const examples = [
    { motion: MOTIONS[0].value, fabric: usualFabric(garment) },
    ...further.map((own) => ({ motion: own, fabric })),
  ];
  const isKnown = examples.some((own) => own.motion === motion && own.fabric === fabric);
  if (isKnown) return 'Nothing changed: it is an example.';
  const changed = [
    ...(examples.some((own) => own.fabric === fabric) ? [] : [`fabric (${fabric})`]),
    ...(examples.some((own) => own.motion === motion) ? [] : [`motion (${motionName(motion)})`]),
  ];
  if (changed.length === 0) return `Changed: ${fabric} and ${motionName(motion)} together.`;
  return `Changed: ${changed.join(' and ')}.`;
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
  const changed = changeSentence(shown);
  const limit = percent(LARGEST_SHARE);
  const lasting = `${percent(fit.lasting_share)} of the faces bent too far for ${FRAMES_TO_FIRE} frames in a row`;
  if (fit.first_fired !== null)
    return {
      light: 'fires',
      title: `Does not fit the ${examples}`,
      detail: `${changed} Up to ${lasting}, more than the ${limit} allowed.`,
    };
  if (fit.n_frames < FRAMES_TO_FIT)
    return {
      light: 'watching',
      title: 'Watching',
      detail: `${changed} ${fit.n_frames} of ${FRAMES_TO_FIT} frames seen: too few to tell.`,
    };
  if (fit.share > LARGEST_SHARE)
    return {
      light: 'uneasy',
      title: 'Fits so far',
      detail: `${changed} ${percent(fit.share)} of the faces bend too far now, for ${fit.n_in_a_row} of ${FRAMES_TO_FIRE} frames; ${limit} are allowed.`,
    };
  return {
    light: 'fits',
    title: `Fits the ${examples}`,
    detail: `${changed} At most ${lasting}; ${limit} are allowed.`,
  };
}

/** Says below the button that plans anew what it does, or why it does nothing now. */
export function anewSentence(state: RefinementState): string {
  if (canPlanAnew(state)) return 'Runs it once on the fine mesh first: half a minute or so.';
  if (isExample(state)) return 'The plan is made of this motion already.';
  return 'For a motion that does not fit, once the light says so.';
}
