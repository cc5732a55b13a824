// Reading of the frames of a side: its numbers, and the signs that it is no cloth any more.
import { frameViews } from '../../shared/bindings/frame';
import type { FrameMessage } from '../../shared/workers/motion-protocol';
import type { Measure } from '../state/failure-cases';
import type { SideState } from '../state/failures-state';

/** The measured sign after a frame: when it was first seen, and its worst value. */
function measuredAfter(
  before: SideState['measured'],
  timeS: number,
  { of, bound }: Measure,
  positions: ArrayLike<number>,
): SideState['measured'] {
  const value = of(positions, timeS);
  if (before) return { ...before, value: Math.max(before.value, value) };
  return value > bound ? { timeS, value } : null;
}

/** The state of a side after a frame; its steps took so long each, as they ran [ms]. */
export function sideAfter(
  before: SideState,
  { report, hasEnded, buffer }: FrameMessage,
  msPerStep: number | null,
  measure?: Measure,
): SideState {
  if (!report) return before;
  const { numbers, message } = report;
  const { time_s: timeS, warnings, largest_stretch: stretch } = numbers;
  const { positions } = frameViews(buffer);
  return {
    warnings,
    ended: hasEnded ? { sentence: message, timeS } : null,
    measured: measure ? measuredAfter(before.measured, timeS, measure, positions) : before.measured,
    mostStretch: Math.max(before.mostStretch, stretch),
    msPerStep,
  };
}
