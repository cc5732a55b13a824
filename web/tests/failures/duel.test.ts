// Both sides of a case, played through the real core.
import { describe, expect, it } from 'vitest';
import { spokenSign } from '../../src/failures/panels/sign-words';
import { Duel, type DuelView } from '../../src/failures/run/duel';
import { caseNamed } from '../../src/failures/state/failure-cases';
import { type FailuresState, initialFailuresState } from '../../src/failures/state/failures-state';
import { inputFailure } from '../../src/shared/bindings/answers';
import { frameViews } from '../../src/shared/bindings/frame';
import type { PleatModule } from '../../src/shared/bindings/pleat-module';
import { createStore } from '../../src/shared/state/store';
import { BrokenWorker } from '../../src/shared/workers/asked';
import type { MotionClient } from '../../src/shared/workers/motion-client';
import { MotionCore } from '../../src/shared/workers/motion-core';
import type { FromMotion } from '../../src/shared/workers/motion-protocol';
import { loadFirst } from '../support/built-module';

/** A worker's end without a worker: each question is answered a moment later, unless it `isDead` by then. */
function clientOf(module: PleatModule, isDead: () => boolean = () => false): MotionClient {
  let answer: FromMotion | null = null;
  const core = new MotionCore(module, (message) => {
    answer = message;
  });
  return {
    async ask(question) {
      await new Promise((resume) => setTimeout(resume));
      if (isDead()) throw new BrokenWorker('killed');
      core.receive(question);
      return answer as unknown as never;
    },
    tell: (message) => core.receive(message),
    terminate: () => core.close(),
  };
}

function createDuel(module: PleatModule, caseId: string) {
  const store = createStore<FailuresState>(initialFailuresState(caseId, []));
  const shown: (ArrayBuffer | null)[] = [null, null];
  const ends: (() => void)[] = []; // one a worker, in the order of their start
  const view: DuelView = {
    showMesh(pane) {
      shown[pane] = null;
    },
    showFrame(pane, buffer) {
      const before = shown[pane] ?? null;
      shown[pane] = buffer;
      return before;
    },
    setColliders() {},
    frame() {},
    follow() {},
  };
  let nowMs = 0;
  const duel = new Duel(store, view, {
    start({ broken }) {
      let isDead = false;
      ends.push(() => {
        isDead = true;
        broken?.('killed');
      });
      return clientOf(module, () => isDead);
    },
    later: (callback) => void setTimeout(callback),
    nowMs: () => {
      nowMs += 20;
      return nowMs;
    },
  });
  const until = async (test: (state: FailuresState) => boolean) => {
    while (!test(store.get())) await new Promise((resume) => setTimeout(resume, 1));
    return store.get();
  };
  const positions = (pane: number) =>
    Array.from(frameViews(shown[pane] ?? new ArrayBuffer(0)).positions);
  return { duel, store, until, positions, ends };
}

describe('a duel', () => {
  it('plays to its end, tells the sign, and begins anew', { timeout: 30000 }, async () => {
    const module = await loadFirst();
    const { duel, until, positions } = createDuel(module, 'rest_on_a_ball');
    await until(({ phase }) => phase === 'ready');
    const rest = positions(1);
    expect(positions(0)).toEqual(rest);
    duel.play();
    const { sides, timeS } = await until(({ playing, timeS: now }) => now > 0 && !playing);
    expect(timeS).toBeCloseTo(caseNamed('rest_on_a_ball').endS, 9);
    expect(sides.naive.warnings.map(({ kind }) => kind)).toContain('stretch');
    expect(sides.ours.warnings).toEqual([]);
    expect(positions(0)).not.toEqual(positions(1));
    duel.play();
    await until((state) => state.playing && state.timeS < timeS);
    duel.pause();
    await duel.reset();
    expect(positions(0)).toEqual(rest);
    expect(positions(1)).toEqual(rest);
  });

  it('shows a case at a time, and plays on from there', async () => {
    const module = await loadFirst();
    const { duel, store, until } = createDuel(module, 'fast_groove');
    await duel.showAt(0.1);
    expect(store.get().timeS).toBeCloseTo(0.1, 9);
    expect(store.get().playing).toBe(false);
    duel.play();
    const { timeS } = await until(({ playing, timeS: now }) => now > 0.1 && !playing);
    expect(timeS).toBeCloseTo(caseNamed('fast_groove').endS, 9);
  });

  it('tells the largest stretch on the way to a time that it shows', {
    timeout: 30000,
  }, async () => {
    const module = await loadFirst();
    const { duel, store } = createDuel(module, 'gathered_curtain');
    await duel.showAt(1);
    const { naive, ours } = store.get().sides;
    const worst = naive.warnings.find(({ kind }) => kind === 'stretch')?.value ?? Number.NaN;
    expect(naive.mostStretch).toBeGreaterThan(0.999 * worst);
    // The curtain falls at first: it is longest then, and hangs shorter at the time shown.
    expect(ours.mostStretch).toBeGreaterThan(0.005);
  });

  it('drops what belonged to the case before', async () => {
    const module = await loadFirst();
    const { duel, store, until } = createDuel(module, 'tumbling');
    await until(({ phase }) => phase === 'ready');
    duel.step();
    store.set({ caseId: 'heavy_bead' });
    const { timeS, sides } = await until(({ phase }) => phase === 'ready');
    expect(timeS).toBe(0);
    expect(sides.naive.warnings).toEqual([]);
  });

  it('says nothing of a case that is shown no more, from the moment of the change on', {
    timeout: 30000,
  }, async () => {
    const module = await loadFirst();
    const { duel, store, until } = createDuel(module, 'rest_on_a_ball');
    let said = '';
    store.subscribe((state, previous) => {
      said = spokenSign(state, previous) ?? said;
    });
    await until(({ phase }) => phase === 'ready');
    duel.play();
    await until(({ sides }) => sides.naive.warnings.length > 0);
    expect(said).toMatch(/^Naive: stretched (like a softer fabric|beyond its load)/);
    store.set({ problem: inputFailure('of the case before') });
    store.set({ caseId: 'fast_groove' });
    const { sides, timeS, problem } = store.get();
    expect([sides.naive.warnings, sides.naive.measured, timeS]).toEqual([[], null, 0]);
    expect(problem).toBeNull();
    expect(said).toBe('');
    await until(({ phase }) => phase === 'ready');
    expect(said).toBe('');
  });

  it('goes on beyond its end for a hand, which pulls the cloth of its pane alone', async () => {
    const module = await loadFirst();
    const { duel, until, positions } = createDuel(module, 'fast_groove');
    await until(({ phase }) => phase === 'ready');
    const { endS } = caseNamed('fast_groove');
    duel.grab(0, 1);
    duel.moveGrab([0, 3, -1]);
    const { timeS } = await until((state) => state.timeS > endS + 0.1);
    duel.releaseGrab();
    duel.pause();
    expect(timeS).toBeGreaterThan(endS);
    expect(positions(1)[1]).toBeGreaterThan((positions(0)[1] ?? 0) + 0.1);
    await duel.reset();
    duel.play();
    const end = await until(({ playing, timeS: now }) => now > 0 && !playing);
    expect(end.timeS).toBeCloseTo(endS, 9);
  });

  it('begins anew, and says why, when a worker ends', async () => {
    const module = await loadFirst();
    const { duel, until, positions, ends } = createDuel(module, 'fast_groove');
    await until(({ phase }) => phase === 'ready');
    const rest = positions(0);
    duel.step();
    await until(({ timeS }) => timeS > 0);
    ends[1]?.();
    const { timeS, problem } = await until(({ phase }) => phase === 'ready');
    expect(ends).toHaveLength(3);
    expect(timeS).toBe(0);
    expect(problem?.what).toMatch(
      /ended by itself \(killed\).*both cloths are back at their start/,
    );
    expect(positions(0)).toEqual(rest);
    duel.step();
    await until(({ timeS: now }) => now > 0);
  });

  it('begins anew when both workers end at once', async () => {
    const { until, ends } = createDuel(await loadFirst(), 'fast_groove');
    await until(({ phase }) => phase === 'ready');
    ends[0]?.();
    ends[1]?.();
    const { problem } = await until(({ phase }) => phase !== 'loading');
    expect(problem?.what).toMatch(/both cloths are back at their start/);
    expect(ends).toHaveLength(4);
  });

  it('tries again when it is asked to, after a worker and its successor have ended', async () => {
    const module = await loadFirst();
    const { duel, until, ends } = createDuel(module, 'fast_groove');
    await until(({ phase }) => phase === 'ready');
    ends[0]?.();
    ends[2]?.();
    const { problem } = await until(({ phase }) => phase === 'broken');
    expect(problem?.what).toMatch(/That happened twice/);
    duel.retry();
    const again = await until(({ phase }) => phase === 'ready');
    expect(again.problem).toBe(null);
  });

  it('says so when a worker breaks', async () => {
    const store = createStore<FailuresState>(initialFailuresState('fast_groove', []));
    const view: DuelView = {
      showMesh() {},
      showFrame: () => null,
      setColliders() {},
      frame() {},
      follow() {},
    };
    new Duel(store, view, {
      start: ({ broken }) => {
        queueMicrotask(() => broken?.('no program'));
        return {
          ask: () => Promise.reject(new BrokenWorker('no program')),
          tell() {},
          terminate() {},
        } as MotionClient;
      },
      later() {},
      nowMs: () => 0,
    });
    await new Promise((resume) => setTimeout(resume));
    const { phase, problem } = store.get();
    expect(phase).toBe('broken');
    expect(problem?.what).toMatch(/WebAssembly/);
  });
});
