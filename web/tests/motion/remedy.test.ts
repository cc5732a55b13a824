// Changes that may help a run that shows nonsense: their order, and on the real module that they do.
import { afterAll, beforeAll, describe, expect, it, vi } from 'vitest';
import { MotionRun } from '../../src/motion/run/motion-run';
import { changesFor } from '../../src/motion/run/remedy-changes';
import { cheapest, tryChanges } from '../../src/motion/run/remedy-trial';
import { tellWarnings } from '../../src/motion/run/warnings';
import { decodeMotionLink } from '../../src/motion/state/motion-link';
import { initialMotionState, type MotionState } from '../../src/motion/state/motion-state';
import {
  MOST_SUBSTEPS,
  presetSetting,
  type Setting,
  sceneOf,
} from '../../src/motion/state/setting';
import { frameViews } from '../../src/shared/bindings/frame';
import type { PleatModule, RunNumbers } from '../../src/shared/bindings/pleat-module';
import type { RunWarning } from '../../src/shared/bindings/run-warning';
import { fabricsText } from '../../src/shared/fabric/fabric-data';
import { warningSentence } from '../../src/shared/panels/warning-words';
import { createStore } from '../../src/shared/state/store';
import { createAsked } from '../../src/shared/workers/asked';
import type { StartMotion } from '../../src/shared/workers/motion-client';
import { MotionCore } from '../../src/shared/workers/motion-core';
import type { FromMotion, ToMotion } from '../../src/shared/workers/motion-protocol';
import { loadFirst } from '../support/built-module';
import { aWarning } from '../support/trial-worker';
import { workerPort } from '../support/worker-port';

const exploding: Setting = { ...presetSetting('curtain'), stepper: 'xpbd', substeps: 1 };
/** Its counts are those that its stepper starts with. */
const untouched: Setting = { ...exploding, substeps: 40 };

const whatHelps = (hints: Record<string, unknown>, setting = untouched) =>
  changesFor({ hints }, setting).map(({ what }) => what);

/** The numbers after so many seconds of a setting. */
async function numbersOf(setting: Setting, seconds: number): Promise<RunNumbers> {
  const { Simulation } = await loadFirst();
  const simulation = new Simulation(fabricsText);
  try {
    expect(JSON.parse(simulation.load(JSON.stringify(sceneOf(setting, null))))).toMatchObject({
      ok: true,
    });
    for (let frame = 0; frame < 60 * seconds; ++frame) simulation.step(1);
    return JSON.parse(simulation.numbers());
  } finally {
    simulation.delete();
  }
}

describe('changes that may help', () => {
  it('are the counts of the start, the hints in their order, more of the same, a calm method', () => {
    const hints = { '/method/substeps': 4, '/method/iterations': 4 };
    expect(whatHelps(hints, exploding)).toEqual([
      '40 substeps',
      '4 substeps',
      '4 iterations',
      '16 substeps',
      '16 iterations',
      'Implicit in 4 substeps',
    ]);
    const [first, second] = changesFor({ hints }, exploding);
    expect(first?.setting).toEqual(untouched);
    expect(first?.why).toBe('The computer looks too rarely: 40 times as often would do.');
    expect(second?.setting).toEqual({ ...exploding, substeps: 4 });
    const pbd = { ...exploding, stepper: 'pbd', iterations: 1 };
    expect(whatHelps({}, pbd)[0]).toBe('13 substeps and 10 iterations');
    expect(whatHelps({}, { ...pbd, substeps: 20 })[0]).toBe('10 iterations');
  });

  it('are none that is at its most, and none twice', () => {
    const most = { ...exploding, substeps: MOST_SUBSTEPS };
    expect(
      whatHelps({ '/method/substeps': 4 * MOST_SUBSTEPS, '/method/iterations': 4 }, most),
    ).toEqual(['4 iterations', '16 iterations', 'Implicit in 4 substeps']);
    const method = { stepper: 'implicit', step_s: 1 / 60, substeps: 4 };
    expect(whatHelps({ '/method': method })).toEqual(['Implicit in 4 substeps']);
  });

  it('are another method with its own counts, or a step that is offered', () => {
    const method = { stepper: 'implicit', step_s: 1 / 60, substeps: 8 };
    const [calm] = changesFor({ hints: { '/method': method } }, untouched);
    expect(calm?.setting).toMatchObject({ stepper: 'implicit', substeps: 8, iterations: 1 });
    expect(whatHelps({ '/method/step_s': 0.005 })[0]).toBe('steps of 1/240 s');
    expect(whatHelps({ '/method/tolerance': 1e-4 })).toEqual(['Implicit in 4 substeps']);
  });
});

describe('words of a warning', () => {
  it('say that a run has exploded only of nonsense', () => {
    expect(warningSentence({ ...aWarning, value: 4e10 })).toContain('many times its length');
    expect(warningSentence({ ...aWarning, value: null })).toContain('many times its length');
    const mild: RunWarning = {
      ...aWarning,
      kind: 'not_converged',
      is_nonsense: false,
      value: 1e-5,
    };
    expect(warningSentence(mild)).toBe(
      'Steps did not converge: from 0.40 s on they left 0.0010 % of their equations unsolved.',
    );
  });
});

/** Workers in this thread. */
const startWith =
  (module: PleatModule): StartMotion =>
  (listener) =>
    createAsked(
      workerPort<ToMotion, FromMotion>((post) => new MotionCore(module, post)),
      listener,
    );

describe('the warnings of a run', () => {
  it('tell of an explosion, and what was tried and holds ends it', async () => {
    const start = startWith(await loadFirst());
    const [warning] = (await numbersOf(exploding, 1)).warnings;
    expect(warning?.kind).toBe('stretch');
    if (!warning) return;
    const question = {
      changes: () => changesFor(warning, exploding),
      mesh: null,
      course: [],
      warning,
    };
    const tried = await tryChanges(start, question, new AbortController().signal);
    const best = cheapest(tried ?? []);
    expect(best?.stepMs).toBeGreaterThan(0);
    if (best) expect((await numbersOf(best.change.setting, 4)).warnings).toEqual([]);
  });

  it('are none for the scene as it is shipped', async () => {
    expect((await numbersOf(presetSetting('curtain'), 1)).warnings).toEqual([]);
  });
});

describe('a remedy on the page', () => {
  beforeAll(() => {
    vi.stubGlobal('requestAnimationFrame', (work: () => void) => setTimeout(work, 1));
  });
  afterAll(() => vi.unstubAllGlobals());

  /** Places after so many steps of a setting. */
  async function placesAt(setting: Setting, steps: number): Promise<Float32Array> {
    const { Simulation } = await loadFirst();
    const simulation = new Simulation(fabricsText);
    simulation.load(JSON.stringify(sceneOf(setting, null)));
    simulation.step(steps);
    const places = simulation.positions().slice();
    simulation.delete();
    return places;
  }

  it('goes on from the last sound state before the warning, and heals the run', async () => {
    const start = startWith(await loadFirst());
    const { link } = decodeMotionLink('#scene=tablecloth&level=1&stepper=xpbd&substeps=1');
    const store = createStore(initialMotionState(link, []));
    const frames: Float32Array[] = [];
    const view = {
      showMesh: () => undefined,
      showFrame: (buffer: ArrayBuffer) => frames.push(frameViews(buffer).positions.slice()),
    };
    const run = new MotionRun(store, view, start);
    tellWarnings(store, run, start);
    const until = async (test: (state: MotionState) => unknown) => {
      await vi.waitUntil(() => test(store.get()), { timeout: 60000 });
      return store.get();
    };
    await until(({ phase }) => phase === 'ready');
    run.play();
    const { problem, numbers } = await until((state) => state.problem?.remedy);
    const { remedy } = problem ?? {};
    const [warning] = numbers?.warnings ?? [];
    if (!warning || !remedy?.from) throw new Error(`it offers ${remedy?.title ?? problem?.help}`);
    expect(remedy.title).toMatch(/^Go on from [\d.]+ s with /);

    frames.length = 0;
    let begin: RunNumbers | null = null;
    run.take(remedy);
    const unsubscribe = store.subscribe(({ phase, numbers: first }) => {
      if (phase === 'ready') begin ??= first;
    });
    await until(() => begin !== null);
    unsubscribe();
    expect(begin).toMatchObject({ step: remedy.from.step });
    const { time_s = 0 } = (begin ?? {}) as Partial<RunNumbers>;
    expect(time_s).toBeGreaterThan(0);
    expect(time_s).toBeLessThan(warning.time_s - 0.09);
    expect(frames[0]).toEqual(await placesAt(link.setting, remedy.from.step));
    const healed = await until((state) => Number(state.numbers?.time_s) > warning.time_s + 1);
    expect(healed.problem).toBeNull();
    run.pause();
  });
});
