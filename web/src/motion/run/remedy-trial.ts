// Tries changes of a setting on copies of the shown run, in a worker of their own: which of them hold, what a
// step of each costs, and whether the run can go on with the best of them from where it was sound.
import type { RunNumbers } from '../../shared/bindings/pleat-module';
import type { RunWarning } from '../../shared/bindings/run-warning';
import { fabricsText } from '../../shared/fabric/fabric-data';
import { affordable } from '../../shared/state/clock';
import { answerOf } from '../../shared/workers/asked';
import type { MotionClient, StartMotion } from '../../shared/workers/motion-client';
import type { Leg, Way } from '../state/motion-state';
import type { ObjMesh } from '../state/obj-mesh';
import { isSameMethod } from '../state/setting';
import type { Change } from './remedy-changes';
import { canKeepMotion, loadOf, wayTo } from './run-content';
import { lastSoundState, type NoSoundState, type SoundState } from './sound-state';

/** Changes that are tried at most, and for how long in all [ms]. */
const MOST_TRIED = 5;
const MOST_MS = 10000;
/** One that is not seen for long enough by then gives way to the next [ms]. */
const PATIENCE_MS = 4000;
/** A step that takes longer than all of that is cut short after so much more [ms]. */
const GRACE_MS = 2000;
/** Time for going on with the best of them from where the run was sound [ms]. */
const GO_ON_MS = 7000;

/** A change that has held for so much longer than the run did holds, unless there is time to look further [s]. */
const BEYOND_S = 1;
/** So far is looked, by when most scenes have come to hang [s], but no longer than that for each [ms]. */
const FAR_S = 3;
const FAR_MS = 3000;

/** Steps after which a cost is known well enough to give up what costs more than what holds. */
const STEPS_TO_JUDGE = 20;

/** Why a run starts anew with what helps: it cannot change on the way, or that does not help there. */
export type WhyAnew = NoSoundState | 'carries nothing' | 'fails again';

/** `fails`: warned of, refused or ended. `late`: cut short before it was seen for long enough. */
type End = 'holds' | 'fails' | 'dearer' | 'late';

export interface Tried {
  change: Change;
  end: End;
  /** So much of its run was seen [s]. */
  seenS: number;
  /** Time of a step; NaN before the second one. */
  stepMs: number;
  /** State of the run from which it holds as well, or why there is none; nothing where that was not tried. */
  from?: SoundState | WhyAnew;
}

export interface Question {
  /** Changes in the order of their rank, asked for anew before each trial: a warning may grow worse. */
  changes(): readonly Change[];
  mesh: ObjMesh | null;
  /** Settings in which the run came to where it is. */
  course: readonly Leg[];
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

interface Limits extends Omit<Question, 'changes' | 'course'> {
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

/** Runs a change until it fails, or has been seen for long enough: from its start, or from a state of the run. */
async function tryOne(
  client: MotionClient,
  change: Change,
  limits: Limits,
  from: Way | null = null,
): Promise<Tried> {
  const tried: Tried = { change, end: 'late', seenS: 0, stepMs: Number.NaN };
  const refuse = () => {
    tried.end = 'fails';
  };
  const content = { setting: change.setting, mesh: limits.mesh };
  const way = from ? wayTo(from) : [];
  const question = { type: 'load', ...loadOf(content), keepMotion: from !== null, way } as const;
  const loaded = await answerOf(client.ask(question), refuse);
  if (!loaded) return tried;
  if (from && loaded.numbers.time_s === 0) return { ...tried, end: 'fails' }; // torn cloth begins anew
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

/** The last sound state of the run, if the change holds from there as well; else why it has to start anew. */
async function soundFrom(
  client: MotionClient,
  { change }: Tried,
  { course, mesh, warning }: Omit<Question, 'changes'>,
): Promise<SoundState | WhyAnew> {
  const last = course.at(-1) ?? null;
  if (!canKeepMotion(last, { setting: change.setting, mesh })) return 'carries nothing';
  const sound = await lastSoundState(client, course, warning);
  if (typeof sound === 'string') return sound;
  const endMs = performance.now() + PATIENCE_MS;
  const limits = { mesh, warning, endMs, mostMs: Number.POSITIVE_INFINITY };
  const { end } = await tryOne(client, change, limits, sound);
  if (end === 'holds') return sound;
  return end === 'late' ? 'too long' : 'fails again';
}

/** Everything that was tried, in that order; null where `signal` ended it. */
export async function tryChanges(
  start: StartMotion,
  { changes, ...question }: Question,
  signal: AbortSignal,
): Promise<Tried[] | null> {
  const client = start({});
  let isEnded = false;
  const stop = () => {
    isEnded = true;
    client.terminate();
  };
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
  const best = cheapest(all);
  if (best && !isEnded) {
    const end = setTimeout(stop, GO_ON_MS);
    best.from = await soundFrom(client, best, question);
    clearTimeout(end);
  }
  signal.removeEventListener('abort', stop);
  stop();
  return signal.aborted ? null : all;
}
