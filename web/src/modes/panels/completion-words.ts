// Words on what the in-betweens show.
import { percent } from '../../shared/panels/quantity';
import type { FilledFrame } from '../bindings/modal-module';
import type { Completion, ModesState } from '../state/modes-state';

/** A frame's volume over what the keys beside it lead one to expect. */
function ratio(frames: readonly FilledFrame[], frame: FilledFrame, volume_m3: number): number {
  const keyVolume = (key: number) =>
    frames.find(({ left, share_of_next }) => left === key && share_of_next === 0)?.volume_m3;
  const from = keyVolume(frame.left) ?? volume_m3;
  const to = keyVolume(frame.left + 1) ?? from;
  return volume_m3 / (from + frame.share_of_next * (to - from));
}

/** Ratios farthest from 1: of the in-betweens and of the straight way. */
export function worstVolumes({ frames }: Pick<Completion, 'frames'>): {
  ours: number;
  straight: number;
} {
  const farthest = (of: (frame: FilledFrame) => number) =>
    frames
      .map((frame) => ratio(frames, frame, of(frame)))
      .reduce((worst, one) => (Math.abs(one - 1) > Math.abs(worst - 1) ? one : worst), 1);
  return {
    ours: farthest((frame) => frame.volume_m3),
    straight: farthest((frame) => frame.straight_volume_m3),
  };
}

function changeWords(change: number): string {
  if (Math.abs(change) < 1e-3) return 'keep their volume to a tenth of a per cent';
  return `${change < 0 ? 'lose' : 'gain'} at most ${percent(Math.abs(change))} of the volume`;
}

/** A ghost this far off is worth pointing at, and so is one this much worse than the in-betweens. */
const SEEN = 0.01;
const MUCH_WORSE = 2;

/** Words on what to notice on the timeline. */
export function storyWords({ completion, keys, phase, working }: ModesState): string {
  if (phase === 'loading' || working) return 'The in-betweens are on their way.';
  if (keys.length < 2) return 'Two keys make a motion: mix some modes and keep them as a key.';
  if (!completion) return 'There are no in-betweens of these keys.';
  const { ours, straight } = worstVolumes(completion);
  const kept = `The in-betweens ${changeWords(ours - 1)}.`;
  const change = Math.abs(straight - 1);
  if (change < SEEN || change < MUCH_WORSE * Math.abs(ours - 1))
    return `${kept} Between these keys the straight way does as well; try keys that turn farther.`;
  return `${kept} The ghost, whose points go straight from key to key, ${straight < 1 ? 'is pinched' : 'swells'} by ${percent(change)}.`;
}

/** How well each in-between is half way. */
export function halvesWords({ frames }: Completion): string {
  const most = Math.max(0, ...frames.map(({ unequal_halves }) => unequal_halves));
  const shown = most < 1e-4 ? 'less than 0.01 %' : percent(most);
  return `Each in-between is the shape half way between two others. Its way to one and to the other differ by ${shown} at most.`;
}
