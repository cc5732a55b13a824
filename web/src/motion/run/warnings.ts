// Tells what a run shows that its scene cannot explain, and what helps: a change is tried before it is offered.
import type { RunNumbers } from '../../shared/bindings/pleat-module';
import type { RunWarning } from '../../shared/bindings/run-warning';
import { digits, shortTime, stepTitle } from '../../shared/panels/quantity';
import { warningSentence } from '../../shared/panels/warning-words';
import { type Store, watch } from '../../shared/state/store';
import { type StartMotion, startMotionWorker } from '../../shared/workers/motion-client';
import type { MotionState, Problem } from '../state/motion-state';
import type { Setting } from '../state/setting';
import { type Change, changesFor } from './remedy-changes';
import { cheapest, meanStepMs, type Tried, tryChanges, type WhyAnew } from './remedy-trial';

const SEEKING = 'Trying what helps…';

/** A told sentence follows its warning this often while the run goes on [ms]: screen readers say each anew. */
const RENEW_EVERY_MS = 1000;

/** No change of a setting is held against what a hand did. */
const PULLED = 'A hand has pulled this cloth: reset it to see what the run does by itself.';

/** Warnings of one vertex; others are of the cloth as a whole. */
const PLACED: readonly RunWarning['kind'][] = ['stretch', 'soft', 'speed'];

/** Words on the cost of a step, beside what one costs now: "14 ms a step, now 6 ms". */
export function costWords(
  step: { ms: number; stepS: number },
  now: { ms: number; stepS: number },
): string {
  const isSameStep = Math.abs(step.stepS - now.stepS) < 1e-9;
  const of = ({ stepS }: { stepS: number }) => (isSameStep ? '' : ` of ${stepTitle(stepS)}`);
  const known = `${shortTime(step.ms)} a step${of(step)}`;
  return Number.isNaN(now.ms) ? known : `${known}, now ${shortTime(now.ms)}${of(now)}`;
}

type Answer = Pick<Problem, 'help' | 'remedy'>;

/** Why the run does not go on from where it was sound. */
const WHY_ANEW: Record<WhyAnew, string> = {
  'carries nothing': 'This cloth cannot change on the way, so it starts again.',
  'never sound': 'The run was wrong from its first steps, so it starts again.',
  'too long': 'To go back would take too long, so it starts again.',
  'fails again': 'It helps from the start alone.',
};

function offer({ change, stepMs, from }: Tried, cost: { ms: number; stepS: number }): Answer {
  const { setting, what, why } = change;
  const costs = costWords({ ms: stepMs, stepS: setting.stepS }, cost);
  if (typeof from === 'object') {
    const { course, step, time_s } = from;
    const title = `Go on from ${digits(time_s, 2)} s with ${what}: ${costs}`;
    return { help: why, remedy: { title, setting, from: { course, step } } };
  }
  const title = `Start again with ${what}: ${costs}`;
  const help = from ? `${why} ${WHY_ANEW[from]}` : why;
  return { help, remedy: { title, setting, startsAnew: true } };
}

/** A change that has held as far as it was seen, which was not far enough to know. */
function guess({ change, seenS }: Tried): Answer {
  const { setting, what } = change;
  const seen =
    seenS > 0 ? `looked right for ${digits(seenS, 2)} s, not tried for longer` : 'not tried';
  const title = `Start again with ${what}: ${seen}`;
  return {
    help: 'What helps is not known for sure.',
    remedy: { title, setting, startsAnew: true },
  };
}

/** Words on what came of trying, with the change to offer. `cost`: of a step of the shown run. */
export function answerTo(tried: readonly Tried[], cost: { ms: number; stepS: number }): Answer {
  const best = cheapest(tried);
  if (best) return offer(best, cost);
  const late = tried.find(({ end }) => end === 'late');
  if (late) return guess(late);
  if (tried.length === 0) return { help: 'Nothing is known that would help.' };
  const names = tried.map(({ change }) => change.what);
  return { help: `None of these helped: ${names.join(', ')}.` };
}

export function tellWarnings(
  store: Store<MotionState>,
  actions: { pause(): void },
  start: StartMotion = startMotionWorker,
): void {
  const told = new Set<RunWarning['kind']>();
  let seeking: { kind: RunWarning['kind']; setting: Setting; end: AbortController } | null = null;
  let toldMs = 0; // when the shown sentence was told

  const present = (kind: RunWarning['kind']): RunWarning | undefined =>
    store.get().numbers?.warnings.find((warning) => warning.kind === kind);

  function changes(warning: RunWarning): Change[] {
    return changesFor(present(warning.kind) ?? warning, store.get().setting);
  }

  /** True while changes are tried for a warning of this kind in the shown setting. */
  function isSought(kind: RunWarning['kind'] | undefined): boolean {
    return seeking !== null && seeking.kind === kind && seeking.setting === store.get().setting;
  }

  function giveUp(): void {
    seeking?.end.abort();
    seeking = null;
  }

  /** Shows a problem with this warning, and then with what helps. */
  async function seek(warning: RunWarning, sentence: string, source: Problem['source']) {
    const { kind } = warning;
    const vertex = PLACED.includes(kind) ? { vertex: warning.vertex } : {};
    const problem: Problem = { source, warning: kind, sentence, ...vertex, help: SEEKING };
    const { setting, mesh, numbers, astray, course } = store.get();
    toldMs = performance.now();
    if (isSought(kind)) return store.set({ problem });
    giveUp();
    if (astray === 'pulled') return store.set({ problem: { ...problem, help: PULLED } });
    const end = new AbortController();
    seeking = { kind, setting, end };
    store.set({ problem });
    const question = { changes: () => changes(warning), mesh, course, warning };
    const tried = await tryChanges(start, question, end.signal);
    if (!tried) return;
    seeking = null;
    const now = { ms: numbers ? meanStepMs(numbers) : Number.NaN, stepS: setting.stepS };
    const { problem: shown } = store.get();
    if (shown) store.set({ problem: { ...shown, ...answerTo(tried, now) } });
  }

  /** Has the shown sentence tell the worst so far; where it was first seen stays marked. */
  function renew({ problem, playing }: MotionState): void {
    const { warning, source } = problem ?? {};
    const now = source === 'setting' && warning && present(warning);
    if (!problem || !now) return;
    const sentence = warningSentence(now);
    const isDue = !playing || performance.now() - toldMs >= RENEW_EVERY_MS;
    if (sentence === problem.sentence || !isDue) return;
    toldMs = performance.now();
    store.set({ problem: { ...problem, sentence } });
  }

  /** Tells the worst that is new, unless nonsense is told of already. */
  function hear(numbers: RunNumbers | null): void {
    const warnings = numbers?.warnings ?? [];
    if (warnings.length === 0) told.clear();
    const fresh = warnings.find(({ kind }) => !told.has(kind));
    if (!fresh) return;
    for (const { kind } of warnings) told.add(kind);
    const { warning: shown } = store.get().problem ?? {};
    if (shown && present(shown)?.is_nonsense) return;
    void seek(fresh, warningSentence(fresh), 'setting');
    if (fresh.is_nonsense) actions.pause();
  }

  watch(store, ['numbers'], ({ numbers }) => hear(numbers));
  watch(store, ['numbers', 'playing'], renew);
  watch(store, ['problem', 'setting', 'phase'], ({ problem, phase, numbers }) => {
    // A run that ended ends with words of its own; what it was warned of says what may help.
    const [worst] = numbers?.warnings ?? [];
    if (phase === 'stopped' && worst && problem?.source === 'run' && problem.help === undefined)
      return void seek(worst, problem.sentence, 'run');
    if (!isSought(problem?.warning)) giveUp();
  });
}
