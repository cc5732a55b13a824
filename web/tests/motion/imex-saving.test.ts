import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { savingWords } from '../../src/motion/panels/method/imex-panel';
import { ImexSavingSource } from '../../src/motion/run/imex-saving-source';
import type { StartMeasuring } from '../../src/motion/run/measuring-client';
import { decodeMotionLink } from '../../src/motion/state/motion-link';
import { initialMotionState, type MotionState } from '../../src/motion/state/motion-state';
import { presetSetting, type Setting, sceneOf, withStepper } from '../../src/motion/state/setting';
import type { RacedMessage, ToRace } from '../../src/motion/worker/measuring-protocol';
import { race } from '../../src/motion/worker/race-core';
import { fabricsText } from '../../src/shared/fabric/fabric-data';
import { createStore } from '../../src/shared/state/store';
import { BrokenWorker } from '../../src/shared/workers/asked';
import { loadFirst } from '../support/built-module';
import { createFakeModule } from '../support/fake-module';

const pendulum = presetSetting('pendulum');

describe('what imex saves', () => {
  it('is told in a sentence', () => {
    const known = { nSprings: 342, substepS: 1 / 420, share: 0.526 };
    const springs = 'Of 342 springs 53 % are implicit in substeps of 2.4 ms';
    expect(savingWords({ ...known, time: 0.613 })).toBe(
      `${springs}; a step takes 0.61 of Implicit’s time.`,
    );
    expect(savingWords({ ...known, time: 'measuring' })).toBe(
      `${springs}; measuring what a step takes …`,
    );
    expect(savingWords({ ...known, time: 'unasked' })).toMatch(/; drag to measure/);
    expect(savingWords({ ...known, time: null })).toMatch(/; .* could not be measured\.$/);
  });
});

describe('imex saving source', () => {
  const FEW = { n_springs: 342 } as NonNullable<MotionState['summary']>;

  /** A race that ends when the test says so. */
  interface Race {
    question: ToRace;
    end(ratio: number | null): void;
    isEnded: boolean;
  }
  let races: Race[] = [];
  const start: StartMeasuring = () => {
    let giveUp = (_: Error): void => undefined;
    const entry = { isEnded: false } as Race;
    return {
      ask: (question) =>
        new Promise((resolve, reject) => {
          if (question.type === 'race') entry.question = question;
          entry.end = (ratio) => resolve({ type: 'raced', ratio } satisfies RacedMessage as never);
          giveUp = reject;
          races.push(entry);
        }),
      tell: () => undefined,
      terminate() {
        entry.isEnded = true;
        giveUp(new BrokenWorker('it was ended'));
      },
    };
  };

  function follow() {
    const { link } = decodeMotionLink('#scene=pendulum');
    const state = initialMotionState({ ...link, setting: pendulum }, []);
    const store = createStore<MotionState>({ ...state, phase: 'ready', summary: FEW });
    const asked: number[] = [];
    let isLate = false;
    /** Twice as many substeps where a share is asked for. */
    const readShare = async ({ stepS, substeps: given, explicitShare }: Setting) => {
      asked.push(given);
      await new Promise((resume) => setTimeout(resume, 5));
      const substeps = explicitShare > 0 ? 2 * given : given;
      return isLate ? null : { substeps, share: 100 * (stepS / substeps) };
    };
    new ImexSavingSource(store, readShare, start);
    return {
      store,
      asked,
      saving: () => store.get().imexSaving,
      drag: (draggedSubsteps: number) => store.set({ draggedSubsteps }),
      setLate(value: boolean) {
        isLate = value;
      },
    };
  }

  const pass = (ms: number) => vi.advanceTimersByTimeAsync(ms);
  const known = (substeps: number) => {
    const substepS = pendulum.stepS / substeps;
    return { nSprings: 342, substepS, share: 100 * substepS };
  };

  beforeEach(() => {
    races = [];
    vi.useFakeTimers();
  });
  afterEach(() => {
    vi.useRealTimers();
  });

  it('tells the share at first, and measures nothing unasked', async () => {
    const page = follow();
    await pass(5);
    expect(page.saving()).toEqual({ ...known(7), time: 'unasked' });
    await pass(5000);
    expect(races).toEqual([]);
  });

  it('tells the substeps that are taken for a share', async () => {
    const page = follow();
    await pass(5);
    page.store.set({ setting: { ...pendulum, explicitShare: 0.5 } });
    await pass(5);
    expect(page.saving()).toEqual({ ...known(14), time: 'measuring' });
  });

  it('follows a drag with one question at a time, and measures where it rests', async () => {
    const page = follow();
    await pass(5);
    for (const substeps of [8, 9, 10, 11]) page.drag(substeps);
    await pass(5);
    expect(page.saving()).toEqual({ ...known(8), time: 'measuring' });
    await pass(5);
    expect(page.saving()).toEqual({ ...known(11), time: 'measuring' });
    expect(page.asked).toHaveLength(3);
    expect(races).toEqual([]);
    await pass(400);
    expect(races).toHaveLength(1);
    expect(JSON.parse(races[0]?.question.sceneText ?? '').method.substeps).toBe(11);
    races[0]?.end(0.6);
    await pass(0);
    expect(page.saving()).toEqual({ ...known(11), time: 0.6 });
    expect(races[0]?.isEnded).toBe(true);
  });

  it('keeps what it measures when the slider is let go, though the cloth is loaded anew', async () => {
    const page = follow();
    await pass(5);
    page.drag(11);
    await pass(405);
    const setting = { ...pendulum, substeps: 11 };
    page.store.set({ setting, draggedSubsteps: null, phase: 'loading' });
    page.store.set({ phase: 'ready' });
    races[0]?.end(0.6);
    await pass(1000);
    expect(page.saving()?.time).toBe(0.6);
    expect(races).toHaveLength(1);
  });

  it('gives up what it measures when the slider is dragged on', async () => {
    const page = follow();
    await pass(5);
    page.drag(11);
    await pass(405);
    page.drag(12);
    expect(races[0]?.isEnded).toBe(true);
    races[0]?.end(0.6);
    await pass(0);
    expect(page.saving()).toEqual({ ...known(11), time: 'measuring' });
    await pass(5);
    expect(page.saving()).toEqual({ ...known(12), time: 'measuring' });
    await pass(400);
    races[1]?.end(0.7);
    await pass(0);
    expect(page.saving()?.time).toBe(0.7);
  });

  it('asks again for a share that came too late, once the cloth is there', async () => {
    const page = follow();
    page.setLate(true);
    page.store.set({ phase: 'loading' });
    await pass(5);
    expect(page.saving()).toBeNull();
    page.setLate(false);
    page.store.set({ phase: 'ready' });
    await pass(5);
    expect(page.saving()).toEqual({ ...known(7), time: 'unasked' });
  });

  it('has nothing to tell of another stepper, and begins anew with the next imex', async () => {
    const page = follow();
    await pass(5);
    page.drag(11);
    await pass(405);
    page.store.set({ setting: withStepper(pendulum, 'implicit'), draggedSubsteps: null });
    expect(page.saving()).toBeNull();
    expect(races[0]?.isEnded).toBe(true);
    page.store.set({ setting: pendulum });
    await pass(5);
    expect(page.saving()).toEqual({ ...known(7), time: 'unasked' });
  });

  it('says so when there is nothing to measure with', async () => {
    const page = follow();
    await pass(5);
    page.drag(11);
    await pass(405);
    races[0]?.end(null);
    await pass(0);
    expect(page.saving()?.time).toBeNull();
  });
});

const MANY_MS = 1000;

/** A module whose steps take time on a clock of its own, the first of a run most of it. */
function timedModule(imexMs: number, implicitMs: number) {
  const { module, alive } = createFakeModule();
  let ms = 0;
  const counts: Record<string, number> = {};
  const methods: Record<string, object> = {};
  class Simulation extends module.Simulation {
    private stepper = '';
    override load(text: string): string {
      const { method } = JSON.parse(text);
      this.stepper = method.stepper;
      methods[method.stepper] = method;
      return super.load(text);
    }
    override step(count: number): number {
      const before = counts[this.stepper] ?? 0;
      counts[this.stepper] = before + count;
      ms += before === 0 ? MANY_MS : count * (this.stepper === 'imex' ? imexMs : implicitMs);
      return super.step(count);
    }
  }
  return { module: { ...module, Simulation }, alive, counts, methods, now: () => ms };
}

const question = (patch: object = {}): ToRace => ({
  type: 'race',
  fabricsText,
  sceneText: JSON.stringify({ ...sceneOf(pendulum), ...patch }),
});

describe('race of imex and implicit', () => {
  it.each([
    [1, 4],
    [4, 1],
    [0.25, 1],
  ])('takes the same steps of each, %d and %d ms long', (imexMs, implicitMs) => {
    const { module, alive, counts, methods, now } = timedModule(imexMs, implicitMs);
    const answer = race(module, question(), now);
    expect(answer).toEqual({ type: 'raced', ratio: imexMs / implicitMs });
    expect(counts.imex).toBe(counts.implicit);
    expect(Math.min(imexMs, implicitMs) * (counts.imex ?? 0)).toBeGreaterThanOrEqual(5 * 50);
    expect(methods.implicit).toEqual({
      stepper: 'implicit',
      solver: 'cg',
      step_s: pendulum.stepS,
      substeps: pendulum.substeps,
      tolerance: 1e-4,
    });
    expect(alive()).toBe(0);
  });

  it('meets solids alike in both', () => {
    const { module, methods, now } = timedModule(1, 1);
    const method = { ...JSON.parse(question().sceneText).method, first_contact_m: 1e-6 };
    race(module, question({ method }), now);
    expect(methods.implicit).toMatchObject({ first_contact_m: 1e-6 });
  });

  it('has fewer rounds where steps take long', () => {
    const { module, counts, now } = timedModule(2000, 2000);
    expect(race(module, question(), now)).toMatchObject({ ratio: 1 });
    expect(counts.imex).toBe(2);
  });

  it('has no ratio when a run ends, and refuses what the module does', () => {
    const { module, alive, now } = timedModule(1, 1);
    expect(race(module, question({ name: 'fragile' }), now)).toMatchObject({ ratio: null });
    const method = { stepper: 'imex', solver: 'cholmod' };
    const lacking = createFakeModule({ hasCholmod: false });
    const refused = race(lacking.module, question({ method }), now);
    expect(refused).toMatchObject({ failure: { where: '/method/solver' } });
    expect([alive(), lacking.alive()]).toEqual([0, 0]);
  });

  it('runs both with the WebAssembly module', async () => {
    const module = await loadFirst();
    let ms = 0;
    const now = () => {
      ms += 10;
      return ms;
    };
    expect(race(module, question(), now)).toEqual({ type: 'raced', ratio: 1 });
  });
});
