// Methods compared on one step: which, how it is asked for, and what is read from it.
import { describe, expect, it } from 'vitest';
import { storyWords } from '../../src/motion/panels/convergence/convergence-chart';
import {
  pointWords,
  readingOf,
  type Way,
  waysOf,
} from '../../src/motion/panels/convergence/convergence-words';
import { ConvergenceRun } from '../../src/motion/run/convergence-run';
import {
  comparedMethods,
  constraintsOf,
  convergenceWish,
  NO_CONVERGENCE,
} from '../../src/motion/state/convergence';
import { decodeMotionLink } from '../../src/motion/state/motion-link';
import { initialMotionState } from '../../src/motion/state/motion-state';
import { presetSetting, withDetail, withStepper } from '../../src/motion/state/setting';
import { studyConvergence } from '../../src/motion/worker/convergence-core';
import type { FromConvergence, ToConvergence } from '../../src/motion/worker/convergence-protocol';
import { createStore } from '../../src/shared/state/store';

const curtain = presetSetting('curtain');
const titlesOf = (...asked: Parameters<typeof comparedMethods>) =>
  comparedMethods(...asked).map(({ title }) => title);

const POSITION_BASED = ['XPBD', 'PBD', 'Hierarchical PBD', 'Multigrid PBD'];

describe('compared methods', () => {
  it('are position-based, and others where constraints are compliant', () => {
    expect(titlesOf(curtain, 'rigid')).toEqual(POSITION_BASED);
    const whole = ['Implicit', 'Projective', ...POSITION_BASED, 'Newton (exact, slow)'];
    expect(titlesOf(curtain, 'compliant')).toEqual(whole);
    const [implicit] = comparedMethods(curtain, 'compliant');
    expect(implicit?.method).toMatchObject({ stepper: 'implicit', tolerance: 0.001 });
  });

  it('are joined by the own one where it is not the usual one', () => {
    const multigrid = withStepper(curtain, 'multigrid');
    expect(titlesOf(multigrid, 'rigid')).toEqual(POSITION_BASED);
    const own = withDetail(multigrid, 'level_lengths', 'error');
    expect(comparedMethods(own, 'rigid').at(-1)).toMatchObject({
      title: 'Multigrid PBD, as set',
      isOwn: true,
      method: { stepper: 'multigrid', level_lengths: 'error' },
    });
  });

  it('have the constraints of the shown method unless others are chosen', () => {
    expect(constraintsOf(curtain)).toBe('rigid');
    const xpbd = withStepper(curtain, 'xpbd');
    expect(constraintsOf(xpbd)).toBe('compliant');
    // A choice for all makes no method of its own.
    expect(titlesOf(withDetail(xpbd, 'constraints', 'rigid'), 'rigid')).toEqual(POSITION_BASED);
  });
});

/** A way through so many [rounds, ms, left]. */
const way = (title: string, ...points: [number, number, number][]): Way => ({
  title,
  isOwn: false,
  stepper: 'pbd',
  points: points.map(([rounds, ms, left]) => ({ rounds, ms, left })),
});

describe('reading of a comparison', () => {
  const slow = way('Slow', [1, 1, 0.5], [2, 2, 0.09], [3, 3, 0.02]);
  const quick = way('Quick', [1, 0.5, 0.3], [3, 1.5, 0.1], [9, 4.5, 0.004]);
  const stuck = way('Stuck', [1, 0.1, 0.9], [513, 50, 0.8]);

  it('is one sentence: who is first, and who never gets there', () => {
    expect(readingOf([slow, quick, stuck])).toBe(
      'First to 0.1 is Quick, after 1.5 ms (never: Stuck); first to 0.01 is Quick, after 4.5 ms (never: Slow); none gets to 0.001.',
    );
    expect(readingOf([stuck])).toBe('None gets to 0.1.');
  });

  it('tells the values of a mark', () => {
    const [point] = quick.points;
    expect(point && pointWords(quick, point)).toBe('Quick after 1 round: 0.50 ms, 0.30 left');
  });

  const series = (values: [number, number, number | null, number | null][]) => ({
    method: { stepper: 'pbd' },
    distance_begin_m: 0.01,
    distance_unknown_m: 1e-12,
    points: values.map(([rounds, ms, relative_error, relative_distance]) => ({
      rounds,
      sweeps: rounds,
      ms,
      relative_error,
      relative_distance,
    })),
  });
  const study = {
    time_s: 0.5,
    step_s: 1 / 60,
    n_vertices: 9,
    n_springs: 16,
    n_bends: 0,
    series: [
      series([
        [1, 0.2, 0.5, 0.9],
        [2, 9, 0.2, 0.8],
        [3, 0.6, 0.1, 0.7],
      ]),
      series([[1, 2, null, 0.03]]),
    ],
  };
  const methods = [way('Own'), way('Whole')].map(({ title }) => ({
    title,
    isOwn: title === 'Own',
    method: {},
  }));

  it('is of errors where springs are rigid, and of distances where not', () => {
    const leftOf = (constraints: 'rigid' | 'compliant') =>
      waysOf({ study, methods, constraints }).map(({ points }) => points.map(({ left }) => left));
    expect(leftOf('rigid')).toEqual([[0.5, 0.2, 0.1], []]);
    expect(leftOf('compliant')).toEqual([[0.9, 0.8, 0.7], [0.03]]);
  });

  it('takes no time for a solve that one of more rounds did not take', () => {
    const [own] = waysOf({ study, methods, constraints: 'rigid' });
    expect(own).toMatchObject({ title: 'Own', isOwn: true });
    expect(own?.points.map(({ ms }) => ms)).toEqual([0.2, 0.6, 0.6]);
  });
});

/** A comparison whose worker says what the test wants. */
function comparison(hash: string) {
  const told: ToConvergence[] = [];
  let nEnded = 0;
  let say: (message: FromConvergence) => void = () => undefined;
  let breakDown: (reason: string) => void = () => undefined;
  const motion = createStore(initialMotionState(decodeMotionLink(hash).link, []));
  const store = createStore(NO_CONVERGENCE);
  let nRests = 0;
  const rest = async () => {
    nRests += 1;
  };
  const run = new ConvergenceRun(motion, store, rest, ({ news, broken }) => {
    say = (message) => news?.(message);
    breakDown = (reason) => broken?.(reason);
    return {
      ask: () => Promise.reject(),
      tell: (message) => void told.push(message),
      terminate: () => {
        nEnded += 1;
      },
    };
  });
  return {
    motion,
    store,
    run,
    told,
    ended: () => nEnded,
    rests: () => nRests,
    say: (message: FromConvergence) => say(message),
    breakDown: (reason: string) => breakDown(reason),
  };
}

describe('a comparison', () => {
  it('asks for the step that is chosen, stops the cloth, tells how far it is, and can be cancelled', async () => {
    const { motion, store, run, told, say, ended, rests } = comparison('scene=curtain&level=1');
    store.set({ begin: 0.25, constraints: 'compliant' });
    await run.start();
    expect(rests()).toBe(1);
    expect(JSON.parse(told[0]?.wishText ?? '')).toEqual(
      JSON.parse(
        JSON.stringify(
          convergenceWish(comparedMethods(motion.get().setting, 'compliant'), 'compliant', 0.25),
        ),
      ),
    );
    expect(JSON.parse(told[0]?.sceneText ?? '').refinement).toEqual({ level: 1 });
    expect(store.get().of).toBe(
      'Curtain, fine cotton, level 1: the step of 1/60 s at 0.25\u00a0s.',
    );
    say({ type: 'progress', done: 0.4 });
    expect(store.get()).toMatchObject({ story: { done: 0.4 }, disturbed: false });
    motion.set({ playing: true });
    expect(store.get().disturbed).toBe(true);
    run.cancel();
    expect(store.get().story).toBe('unasked');
    expect(ended()).toBe(1);
  });

  it('is not begun when it is cancelled before the cloth rests', async () => {
    const { store, run, told } = comparison('scene=curtain');
    const begun = run.start();
    run.cancel();
    await begun;
    expect(told).toEqual([]);
    expect(store.get().story).toBe('unasked');
  });

  it('says why a step cannot be studied, and what helps', async () => {
    const { store, run, say, breakDown } = comparison('scene=curtain&model=membrane');
    await run.start();
    const failure = {
      ok: false,
      kind: 'input',
      where: '/model',
      what: 'expected springs',
    } as const;
    say({ type: 'refused', failure });
    expect(storyWords(store.get().story)).toBe(
      'This step cannot be studied: /model: expected springs. Springs can be compared: choose them as the model of the cloth.',
    );
    await run.start();
    breakDown('no network');
    expect(storyWords(store.get().story)).toMatch(/The comparison cannot be computed.*no network/);
    const mesh = comparison('scene=obj');
    await mesh.run.start();
    mesh.say({ type: 'refused', failure });
    expect(storyWords(mesh.store.get().story)).toMatch(/Springs need the threads of a sheet\.$/);
  });

  it('hands over what the module says, and little progress not at all', () => {
    const posted: FromConvergence[] = [];
    const ask = (answer: string) =>
      studyConvergence(
        {
          studyConvergence: (_fabrics, _scene, _wish, hear) => {
            for (const done of [0.001, 0.5, 0.501, 1]) hear(done);
            return answer;
          },
        },
        { type: 'studyConvergence', fabricsText: '', sceneText: '', wishText: '' },
        (message) => posted.push(message),
      );
    ask('{"ok": true, "study": {"series": []}}');
    expect(posted).toEqual([
      { type: 'progress', done: 0.5 },
      { type: 'progress', done: 1 },
      { type: 'studied', study: { series: [] } },
    ]);
    ask('no JSON');
    expect(posted.at(-1)).toMatchObject({ type: 'refused', failure: { kind: 'internal' } });
  });
});
