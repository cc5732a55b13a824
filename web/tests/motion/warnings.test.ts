// A run's warnings as the page tells them: what is wrong at once, what helps once it was tried.
import { afterEach, describe, expect, it, vi } from 'vitest';
import type { Tried } from '../../src/motion/run/remedy-trial';
import { answerTo, costWords, tellWarnings } from '../../src/motion/run/warnings';
import { decodeMotionLink } from '../../src/motion/state/motion-link';
import { initialMotionState } from '../../src/motion/state/motion-state';
import { presetSetting } from '../../src/motion/state/setting';
import type { RunNumbers } from '../../src/shared/bindings/pleat-module';
import type { RunWarning } from '../../src/shared/bindings/run-warning';
import { warningSentence } from '../../src/shared/panels/warning-words';
import { createStore } from '../../src/shared/state/store';
import { aWarning, type Behaviour, type Method, trialWorkers } from '../support/trial-worker';

const numbers = (...warnings: RunWarning[]) =>
  ({ time_s: 0.5, steps_ms: 60, steps_timed: 10, warnings }) as unknown as RunNumbers;
const exploded = numbers({ ...aWarning, hints: { '/method/substeps': 4 } });

/** A trial of a stand-in takes part of a second [ms]. */
const PATIENCE_MS = 20000;

/** A page that plays a run, and what tells of it. */
function open(behaviourOf: (method: Method) => Behaviour) {
  const { link } = decodeMotionLink('#scene=swinging-sheet&level=0&stepper=xpbd&substeps=1');
  const course = [{ setting: link.setting, mesh: null, fromStep: 0 }];
  const store = createStore({ ...initialMotionState(link, []), playing: true, course });
  const workers = trialWorkers(behaviourOf);
  const pause = vi.fn();
  tellWarnings(store, { pause }, workers.start);
  return { store, pause, ...workers, problem: () => store.get().problem };
}

const holds = ({ substeps = 0 }: Method): Behaviour =>
  substeps >= 16 ? { stepMs: 14 } : { stepMs: 5, warnedS: 0.4 };

afterEach(() => vi.restoreAllMocks());

describe('a warning', () => {
  it('is told at once with its place, and with what helps and costs once that was tried', async () => {
    const { store, pause, problem } = open(holds);
    store.set({ numbers: exploded });
    expect(pause).toHaveBeenCalledOnce();
    expect(problem()).toMatchObject({ warning: 'stretch', vertex: 2, help: 'Trying what helps…' });
    expect(problem()?.sentence).toMatch(/^The cloth stretches too much: .* by up to 98 %/);
    expect(problem()?.remedy).toBeUndefined();
    await vi.waitUntil(() => problem()?.remedy, PATIENCE_MS);
    expect(problem()?.help).toBe('The computer looks too rarely: 30 times as often would do.');
    expect(problem()?.remedy).toEqual({
      title: 'Go on from 0.30 s with 30 substeps: 14 ms a step, now 6.0 ms',
      setting: { ...store.get().setting, substeps: 30 },
      from: { course: store.get().course, step: 18 },
    });
  });

  it('says that nothing helps where nothing of what was tried does', async () => {
    const { store, problem } = open(() => ({ stepMs: 1, warnedS: 0.1 }));
    store.set({ numbers: exploded });
    await vi.waitUntil(() => problem()?.help !== 'Trying what helps…', PATIENCE_MS);
    expect(problem()?.help).toBe(
      'None of these helped: 30 substeps, 4 substeps, 16 substeps, Implicit in 4 substeps.',
    );
    expect(problem()?.remedy).toBeUndefined();
  });

  it.each([
    ['another setting', 'setting'],
    ['a dismissal', 'problem'],
  ])('is not answered any more after %s', async (_, key) => {
    const { store, problem, alive } = open(holds);
    store.set({ numbers: exploded });
    expect(alive()).toBe(1);
    const { setting } = store.get();
    store.set(key === 'setting' ? { setting: { ...setting, level: 1 } } : { problem: null });
    expect(alive()).toBe(0);
    await new Promise((resume) => setTimeout(resume, 50));
    expect(problem()?.remedy).toBeUndefined();
  });

  it('is told once a run, and again in the next one', async () => {
    const { store, problem } = open(holds);
    store.set({ numbers: exploded });
    store.set({ problem: null });
    store.set({ numbers: { ...exploded } });
    expect(problem()).toBeNull();
    store.set({ numbers: numbers() });
    store.set({ numbers: { ...exploded } });
    expect(problem()?.warning).toBe('stretch');
    store.set({ problem: null });
  });

  it('of nonsense takes the place of a mild one, which does not pause the run; and not the reverse', () => {
    const { store, pause, problem } = open(holds);
    const mild: RunWarning = { ...aWarning, kind: 'not_converged', is_nonsense: false };
    store.set({ numbers: numbers(mild) });
    expect(problem()).toMatchObject({ warning: 'not_converged' });
    expect(problem()?.vertex).toBeUndefined();
    expect(pause).not.toHaveBeenCalled();
    store.set({ numbers: numbers(aWarning, mild) });
    expect(problem()?.warning).toBe('stretch');
    store.set({ numbers: numbers(aWarning, { ...mild, kind: 'soft' }, mild) });
    expect(problem()?.warning).toBe('stretch');
    store.set({ problem: null });
  });

  it('tells the worst value so far, and goes on trying what helps', async () => {
    const { store, problem, alive, tried } = open(holds);
    const grown = (value: number) =>
      numbers({ ...aWarning, value, vertex: 7, hints: { '/method/substeps': 8 } });
    store.set({ numbers: exploded, playing: false });
    store.set({ numbers: grown(1.2) });
    expect(problem()?.sentence).toMatch(/^The run has exploded: .* by up to 120 %/);
    store.set({ numbers: grown(2.4) });
    expect(problem()).toMatchObject({ vertex: 2, help: 'Trying what helps…' });
    expect(problem()?.sentence).toMatch(/ by up to 240 %/);
    expect(alive()).toBe(1);
    await vi.waitUntil(() => problem()?.remedy, PATIENCE_MS);
    expect(problem()?.sentence).toMatch(/ by up to 240 %/);
    expect(tried.map(({ substeps }) => substeps).slice(0, 2)).toEqual([30, 8]);
    store.set({ problem: null });
  });

  it('is told anew at most once a second while it grows, and at once when the run stands', () => {
    const now = vi.spyOn(performance, 'now');
    const { store, problem } = open(holds);
    const told = new Set<string | undefined>();
    const grow = (ms: number, value: number) => {
      now.mockReturnValue(ms);
      store.set({ numbers: numbers({ ...aWarning, value }) });
      told.add(problem()?.sentence);
    };
    for (let look = 0; look <= 10; ++look) grow(5000 + 200 * look, 1 + look / 10);
    expect(told.size).toBe(3);
    grow(7100, 2.1);
    expect(told.size).toBe(3);
    store.set({ playing: false });
    expect(problem()?.sentence).toBe(warningSentence({ ...aWarning, value: 2.1 }));
    store.set({ problem: null });
  });

  it('helps a run that has ended too, beside the words on its end', async () => {
    const { store, problem, nStarted } = open(holds);
    store.set({ numbers: exploded });
    const end = { source: 'run', sentence: 'The run stopped in step 31.' } as const;
    store.set({ phase: 'stopped', playing: false, problem: end });
    await vi.waitUntil(() => problem()?.remedy, PATIENCE_MS);
    expect(problem()).toMatchObject({ ...end, vertex: 2 });
    expect(nStarted()).toBe(1);
  });
});

describe('what helps from the start alone', () => {
  it('starts again, and says why', () => {
    const change = { setting: presetSetting('curtain'), what: '16 substeps', why: 'Too rarely.' };
    const tried: Tried = { change, end: 'holds', seenS: 3, stepMs: 14, from: 'never sound' };
    const cost = { ms: 6, stepS: change.setting.stepS };
    expect(answerTo([tried], cost)).toEqual({
      help: 'Too rarely. The run was wrong from its first steps, so it starts again.',
      remedy: {
        title: 'Start again with 16 substeps: 14 ms a step, now 6.0 ms',
        setting: change.setting,
        startsAnew: true,
      },
    });
  });
});

describe('what was tried until time was over', () => {
  it('is offered with how far it was seen, and never as what helps', () => {
    const setting = presetSetting('curtain');
    const change = { setting, what: '16 substeps', why: '' };
    const failed: Tried = {
      change: { ...change, what: '4 substeps' },
      end: 'fails',
      seenS: 1,
      stepMs: 1,
    };
    const late: Tried = { change, end: 'late', seenS: 0.62, stepMs: 90 };
    const cost = { ms: 6, stepS: setting.stepS };
    expect(answerTo([failed, late], cost)).toEqual({
      help: 'What helps is not known for sure.',
      remedy: {
        title: 'Start again with 16 substeps: looked right for 0.62 s, not tried for longer',
        setting,
        startsAnew: true,
      },
    });
    expect(answerTo([{ ...late, seenS: 0 }], cost).remedy?.title).toMatch(/: not tried$/);
    expect(answerTo([], cost)).toEqual({ help: 'Nothing is known that would help.' });
  });
});

describe('words on costs', () => {
  it('name the steps where these are of different length, and no cost that nobody measured', () => {
    const [frame, half] = [1 / 60, 1 / 120];
    expect(costWords({ ms: 14, stepS: frame }, { ms: 6, stepS: frame })).toBe(
      '14 ms a step, now 6.0 ms',
    );
    expect(costWords({ ms: 9, stepS: half }, { ms: 6, stepS: frame })).toBe(
      '9.0 ms a step of 1/120 s, now 6.0 ms of 1/60 s',
    );
    expect(costWords({ ms: 14, stepS: frame }, { ms: Number.NaN, stepS: frame })).toBe(
      '14 ms a step',
    );
  });
});
