// The last sound state of a run that went wrong: its course is run once more, and looked at on the way.
import type { RunNumbers } from '../../shared/bindings/pleat-module';
import type { RunWarning } from '../../shared/bindings/run-warning';
import { answerOf } from '../../shared/workers/asked';
import type { MotionClient } from '../../shared/workers/motion-client';
import type { Leg, Way } from '../state/motion-state';
import { loadOf, wayTo } from './run-content';

/** A state is sound that lies so long before the first sight of what is wrong [s]. */
const BEFORE_S = 0.1;
/** Largest stretch of a thread in a sound state: woven cloth tears at about this. */
const MOST_STRETCH = 0.1;

/** The last stretch of the course is looked at so often at most: more costs more than the steps. */
const MOST_LOOKS = 60;
/** A course that takes longer is not run again [ms]. */
const PATIENCE_MS = 3000;

/** Rounding may leave a time a hair short of a step [steps]. */
const HAIR = 1e-6;

export interface SoundState extends Way {
  time_s: number;
}

/** Why there is none: each was wrong, or nobody waits until that is known. */
export type NoSoundState = 'never sound' | 'too long';

/** True once cloth shows what its scene cannot explain: such a stretch is not worked off at once. */
const isWrong = ({ warnings }: RunNumbers) =>
  warnings.some(({ kind, is_nonsense }) => is_nonsense || kind === 'soft');

/** The state at these numbers; null where it is at rest at the start, or not sound. */
function soundAt(course: readonly Leg[], numbers: RunNumbers): SoundState | null {
  const { time_s, step, largest_stretch } = numbers;
  const isSound = time_s > 0 && largest_stretch <= MOST_STRETCH && !isWrong(numbers);
  return isSound ? { course, step, time_s } : null;
}

/** The last sound state before a warning, or why there is none. */
export async function lastSoundState(
  client: MotionClient,
  course: readonly Leg[],
  warning: Pick<RunWarning, 'time_s'>,
): Promise<SoundState | NoSoundState> {
  const last = course.at(-1);
  if (!last) return 'never sound';
  const endMs = performance.now() + PATIENCE_MS;
  const before = course.slice(0, -1);
  const way = wayTo({ course: before, step: last.fromStep });
  const keepMotion = before.length > 0;
  const question = { type: 'load', ...loadOf(last), keepMotion, way } as const;
  const loaded = await answerOf(client.ask(question), () => undefined);
  if (!loaded) return 'too long';
  let sound = soundAt(before, loaded.numbers);
  let [buffer] = loaded.buffers;
  const { time_s: beginS } = loaded.numbers;
  let left = Math.floor((warning.time_s - BEFORE_S - beginS) / last.setting.stepS + HAIR);
  const atOnce = Math.max(1, Math.ceil(left / MOST_LOOKS));
  while (left > 0) {
    const count = Math.min(left, atOnce);
    const steps = { type: 'step', count, buffer, wantsNumbers: true } as const;
    const frame = await answerOf(client.ask(steps, [buffer]), () => undefined);
    if (frame?.type !== 'frame' || !frame.report) return 'too long';
    const { numbers } = frame.report;
    if (frame.hasEnded || isWrong(numbers)) break;
    if (performance.now() > endMs) return 'too long';
    sound = soundAt(course, numbers) ?? sound;
    buffer = frame.buffer;
    left -= count;
  }
  if (sound || before.length === 0) return sound ?? 'never sound';
  return lastSoundState(client, before, { time_s: beginS + BEFORE_S });
}
