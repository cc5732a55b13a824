// Tries changes of a setting on copies of the shown run, in a worker of their own: which of them hold, and
// what a step of each costs.
import type { RunNumbers } from '../../shared/bindings/pleat-module';
import type { RunWarning } from '../../shared/bindings/run-warning';
import { fabricsText } from '../../shared/fabric/fabric-data';
import { affordable } from '../../shared/state/clock';
import { answerOf } from '../../shared/workers/asked';
import type { MotionClient, StartMotion } from '../../shared/workers/motion-client';
import type { ObjMesh } from '../state/obj-mesh';
import { isSameMethod } from '../state/setting';
import type { Change } from './remedy-changes';
import { loadOf } from './run-content';

/** Changes that are tried at most, and for how long in all [ms]. */
const MOST_TRIED = 5;
const MOST_MS = 10000;
/** One that is not seen for long enough by then gives way to the next [ms]. */
const PATIENCE_MS = 4000;
/** A step that takes longer than all of that is cut short after so much more [ms]. */
const GRACE_MS = 2000;

/** A change that has held for so much longer than the run did holds, unless there is time to look further [s]. */
const BEYOND_S = 1;
/** So far is looked, by when most scenes have come to hang [s], but no longer than that for each [ms]. */
const FAR_S = 3;
const FAR_MS = 3000;

/** Steps after which a cost is known well enough to give up what costs more than what holds. */
const STEPS_TO_JUDGE = 20;

/** `fails`: warned of, refused or ended. `late`: cut short before it was seen for long enough. */
type End = 'holds' | 'fails' | 'dearer' | 'late';

export interface Tried {
  change: Change;
  end: End;
  /** So much of its run was seen [s]. */
  seenS: number;
  /** Time of a step; NaN before the second one. */
  stepMs: number;
}

export interface Question {
  /** Changes in the order of their rank, asked for anew before each trial: a warning may grow worse. */
  changes(): readonly Change[];
  mesh: ObjMesh | null;
  /** The warning that is to go. */
  warning: Pick<RunWarning, 'kind' | 'time_s'>;
}

/** Mean over the steps after the first; NaN where there is none. */
export function meanStepMs({ steps_ms, steps_timed }: RunNumbers): number {
  return steps_timed > 0 ? steps_ms / steps_timed : Number.NaN;
}

/** Time of a second of motion [ms]: steps of different length compare by that. */
const secondMs = ({ change, stepMs }: Tried) => stepMs / change.setting.stepS;

/** The cheapest of those that hold. */
export function cheapest(tried: readonly Tried[]): Tried | undefined {
  return tried.filter(({ end }) => end === 'holds').sort((a, b) => secondMs(a) - secondMs(b))[0];
}

interface Limits extends Omit<Question, 'changes'> {
  /** Nothing goes on for longer than that [ms on the clock]. */
  endMs: number;
  /** Time of a second of what holds by now [ms]. */
  mostMs: number;
}

/** The end of a trial that stands at these numbers; null while it goes on. */
function endOf(tried: Tried, numbers: RunNumbers, beginMs: number, limits: Limits): End | null {
  const { warning, endMs, mostMs } = limits;
  // A factor that helps a solver out is no fault of the run, unless that was the warning.
  const isAlarm = ({ kind }: RunWarning) => kind !== 'given_up' || kind === warning.kind;
  if (numbers.warnings.some(isAlarm)) return 'fails';
  if (numbers.steps_timed >= STEPS_TO_JUDGE && secondMs(tried) > mostMs) return 'dearer';
  const now = performance.now();
  const holds = numbers.time_s >= warning.time_s + BEYOND_S;
  if (holds && (numbers.time_s >= FAR_S || now - beginMs > FAR_MS)) return 'holds';
  if (now > endMs || now - beginMs > PATIENCE_MS) return holds ? 'holds' : 'late';
  return null;
}

/** Runs a change until it fails, or has been seen for long enough. */
async function tryOne(client: MotionClient, change: Change, limits: Limits): Promise<Tried> {
  const tried: Tried = { change, end: 'late', seenS: 0, stepMs: Number.NaN };
  const refuse = () => {
    tried.end = 'fails';
  };
  const content = { setting: change.setting, mesh: limits.mesh };
  const question = { type: 'load', ...loadOf(content), keepMotion: false } as const;
  const loaded = await answerOf(client.ask(question), refuse);
  if (!loaded) return tried;
  let [buffer] = loaded.buffers;
  const beginMs = performance.now();
  while (true) {
    const count = affordable(Number.isNaN(tried.stepMs) ? null : tried.stepMs);
    const steps = { type: 'step', count, buffer, wantsNumbers: true } as const;
    const frame = await answerOf(client.ask(steps, [buffer]), refuse);
    if (frame?.type !== 'frame' || !frame.report) return tried;
    const { numbers } = frame.report;
    buffer = frame.buffer;
    tried.seenS = numbers.time_s;
    tried.stepMs = meanStepMs(numbers);
    const end = frame.hasEnded ? 'fails' : endOf(tried, numbers, beginMs, limits);
    if (end) return { ...tried, end };
  }
}

/** Everything that was tried, in that order; null where `signal` ended it. */
export async function tryChanges(
  start: StartMotion,
  { changes, ...question }: Question,
  signal: AbortSignal,
): Promise<Tried[] | null> {
  const client = start({});
  const stop = () => client.terminate();
  signal.addEventListener('abort', stop);
  const endMs = performance.now() + MOST_MS;
  const last = setTimeout(stop, MOST_MS + GRACE_MS);
  const all: Tried[] = [];
  const isNew = ({ setting }: Change) =>
    !all.some(({ change }) => isSameMethod(change.setting, setting));
  await answerOf(client.ask({ type: 'open', fabricsText }), () => undefined);
  while (all.length < MOST_TRIED && performance.now() < endMs && !signal.aborted) {
    const next = changes().find(isNew);
    if (!next) break;
    const best = cheapest(all);
    const mostMs = best ? secondMs(best) : Number.POSITIVE_INFINITY;
    all.push(await tryOne(client, next, { ...question, endMs, mostMs }));
  }
  clearTimeout(last);
  signal.removeEventListener('abort', stop);
  stop();
  return signal.aborted ? null : all;
}
