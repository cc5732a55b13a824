// What the in-betweens show, in words.
import { percent } from '../../shared/panels/quantity';
import type { Completion, ModesState } from '../state/modes-state';

/** Volumes over that of the first key, at their farthest from it. */
function worstVolumes({ frames }: Completion): { ours: number; straight: number } {
  const rest = frames[0]?.volume_m3 ?? 1;
  const farthest = (values: number[]) =>
    values.reduce((worst, value) =>
      Math.abs(value / rest - 1) > Math.abs(worst / rest - 1) ? value : worst,
    ) / rest;
  return {
    ours: farthest(frames.map(({ volume_m3 }) => volume_m3)),
    straight: farthest(frames.map(({ straightVolume_m3 }) => straightVolume_m3)),
  };
}

function ofVolume(ratio: number): string {
  return `${Math.round(1000 * ratio) / 10} %`;
}

/** What to notice on the timeline. */
export function storyWords({ completion, keys, phase, working }: ModesState): string {
  if (phase === 'loading' || working) return 'The in-betweens are on their way.';
  if (keys.length < 2) return 'Two keys make a motion: mix some modes and keep them as a key.';
  if (!completion) return 'There are no in-betweens of these keys.';
  const { ours, straight } = worstVolumes(completion);
  const kept = `At worst the in-betweens have ${ofVolume(ours)} of the volume`;
  if (Math.abs(straight - 1) < 2 * Math.abs(ours - 1) + 0.005)
    return `${kept}, the straight way from key to key ${ofVolume(straight)}: between these keys it does nearly as well.`;
  return `${kept}. The ghost, which takes every point straight from key to key, is ${straight < 1 ? 'pinched' : 'swollen'} to ${ofVolume(straight)}.`;
}

/** How well each in-between is half way. */
export function halvesWords({ frames }: Completion): string {
  const most = Math.max(0, ...frames.map(({ unequalHalves }) => unequalHalves));
  const shown = most < 1e-4 ? 'less than 0.01 %' : percent(most);
  return `Each in-between is the shape half way between two others. Its way to one and to the other differ by ${shown} at most.`;
}
