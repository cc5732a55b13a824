// The account of energy over a run, thinned out so that a long run takes no more room than a short one.
import type { EnergyNumbers } from '../../shared/bindings/pleat-module';

/** More points than these would lie closer than a pixel. */
const MOST_SAMPLES = 512;

/** Thins samples to half as many at most, evenly over the time of all of them. */
function thinned(samples: readonly EnergyNumbers[]): EnergyNumbers[] {
  const begin = samples[0]?.time_s ?? 0;
  const gap = (2 * ((samples.at(-1)?.time_s ?? 0) - begin)) / MOST_SAMPLES;
  let next = begin;
  return samples.filter(({ time_s }) => {
    const isDue = time_s >= next;
    if (isDue) next = time_s + gap;
    return isDue;
  });
}

/** Samples with one more at the end, in place of one of the same time; thinned out when there are too many. */
export function withSample(
  samples: readonly EnergyNumbers[],
  sample: EnergyNumbers,
): readonly EnergyNumbers[] {
  const isSameTime = samples.at(-1)?.time_s === sample.time_s;
  const earlier = isSameTime ? samples.slice(0, -1) : samples;
  return [...(earlier.length < MOST_SAMPLES ? earlier : thinned(earlier)), sample];
}
