// Both sides of a case, played through the real core.
import { describe, expect, it } from 'vitest';
import { Duel, type DuelView } from '../../src/failures/run/duel';
import { caseNamed } from '../../src/failures/state/failure-cases';
import { type FailuresState, initialFailuresState } from '../../src/failures/state/failures-state';
import { frameViews } from '../../src/shared/bindings/frame';
import type { PleatModule } from '../../src/shared/bindings/pleat-module';
import { createStore } from '../../src/shared/state/store';
import { BrokenWorker } from '../../src/shared/workers/asked';
import type { MotionClient } from '../../src/shared/workers/motion-client';
import { MotionCore } from '../../src/shared/workers/motion-core';
import type { FromMotion } from '../../src/shared/workers/motion-protocol';
import { loadFirst } from '../support/built-module';

/** A worker's end without a worker: each question is answered a moment later. */
function clientOf(module: PleatModule): MotionClient {
  let answer: FromMotion | null = null;
  const core = new MotionCore(module, (message) => {
    answer = message;
  });
  return {
    async ask(question) {
      await new Promise((resume) => setTimeout(resume));
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
  const nSprings = [0, 0];
  const view: DuelView = {
    showMesh(pane, { springEnds }) {
      shown[pane] = null;
      nSprings[pane] = springEnds.length / 2;
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
    start: () => clientOf(module),
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
  return { duel, store, until, positions, nSprings };
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

  it('keeps the last good frame of a side that ended, while the other goes on', async () => {
    const module = await loadFirst();
    const { duel, until, positions } = createDuel(module, 'hundredfold_stiffness');
    await until(({ phase }) => phase === 'ready');
    const rest = positions(0);
    for (let step = 1; step <= 3; ++step) {
      duel.step();
      await until(({ timeS }) => timeS > (step - 0.5) / 60);
    }
    const { sides } = await until(() => true);
    expect(sides.naive.ended?.sentence).toMatch(/diverged/);
    expect(sides.ours.ended).toBe(null);
    expect(positions(0)).toEqual(rest);
    expect(positions(1)).not.toEqual(rest);
  });

  it('drops what belonged to the case before', async () => {
    const module = await loadFirst();
    const { duel, store, until, nSprings } = createDuel(module, 'needle_cells');
    await until(({ phase }) => phase === 'ready');
    duel.step();
    store.set({ caseId: 'tumbling' });
    const { timeS, sides } = await until(({ phase }) => phase === 'ready');
    expect(timeS).toBe(0);
    expect(sides.naive.warnings).toEqual([]);
    expect(nSprings[0]).toBeGreaterThan(0); // it is no surface
  });

  it('says so when a worker breaks', async () => {
    const store = createStore<FailuresState>(initialFailuresState('tumbling', []));
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
