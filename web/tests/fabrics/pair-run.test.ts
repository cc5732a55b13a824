// Two fabrics in one scene, in step, through the real core.
import { describe, expect, it } from 'vitest';
import { apartWords } from '../../src/fabrics/panels/pair-panel';
import { farthestApart, PairRun, type PairView } from '../../src/fabrics/run/pair-run';
import { initialPairState, type PairLink, type PairState } from '../../src/fabrics/state/pair';
import { frameViews } from '../../src/shared/bindings/frame';
import type { PleatModule } from '../../src/shared/bindings/pleat-module';
import { createStore } from '../../src/shared/state/store';
import { createAsked } from '../../src/shared/workers/asked';
import { MotionCore } from '../../src/shared/workers/motion-core';
import type { FromMotion, ToMotion } from '../../src/shared/workers/motion-protocol';
import { loadFirst } from '../support/built-module';
import { workerPort } from '../support/worker-port';

function createPair(module: PleatModule, link: PairLink) {
  const store = createStore(initialPairState(link, null));
  const shown: (ArrayBuffer | null)[] = [null, null];
  const view: PairView = {
    showMesh: (pane) => {
      shown[pane] = null;
    },
    showFrame(pane, buffer) {
      const before = shown[pane] ?? null;
      shown[pane] = buffer;
      return before;
    },
    begin: () => undefined,
    positions: (pane) => frameViews(shown[pane] ?? new ArrayBuffer(0)).positions,
  };
  const ends: ((reason: string) => void)[] = [];
  let nowMs = 0;
  const run = new PairRun(store, view, {
    start(listener) {
      if (listener.broken) ends.push(listener.broken);
      return createAsked(
        workerPort<ToMotion, FromMotion>((post) => new MotionCore(module, post)),
        listener,
      );
    },
    later: (callback) => void setTimeout(callback),
    nowMs: () => {
      nowMs += 20;
      return nowMs;
    },
  });
  const until = async (test: (state: PairState) => boolean) => {
    while (!test(store.get())) await new Promise((resume) => setTimeout(resume, 1));
    return store.get();
  };
  return { store, run, until, ends, places: (pane: number) => Array.from(view.positions(pane)) };
}

describe('two fabrics in motion', { timeout: 120000 }, () => {
  it('begin alike and part: three hooks tell silk from canvas', async () => {
    const link: PairLink = { scene: 'swags', pair: ['silk', 'canvas'] };
    const { run, until, places } = createPair(await loadFirst(), link);
    await until(({ phase }) => phase === 'ready');
    expect(places(0)).toEqual(places(1));
    run.play();
    const state = await until(({ timeS }) => timeS >= 4);
    run.pause();
    expect(state.apartM).toBeGreaterThan(0.03);
    expect(state.apartM).toBeCloseTo(farthestApart(places(0), places(1)), 6);
    expect(apartWords(state)).toMatch(/on silk and on canvas is up to [\d.]+ cm apart/);
  });

  it('are one motion where both are the same fabric, under one hand', async () => {
    const link: PairLink = { scene: 'strip', pair: ['wool', 'wool'] };
    const { run, until, places } = createPair(await loadFirst(), link);
    await until(({ phase }) => phase === 'ready');
    const last = places(0).length / 3 - 1;
    const before = places(0);
    run.grab(last, 1);
    const [x = 0, y = 0, z = 0] = before.slice(3 * last);
    run.moveGrab([x, y + 0.01, z - 0.01]);
    await until(({ timeS }) => timeS >= 0.5);
    run.releaseGrab();
    run.pause();
    expect(farthestApart(before, places(0))).toBeGreaterThan(0.005);
    expect(places(0)).toEqual(places(1));
  });

  it('begin anew with other workers when one ends, and say so; after two ends they wait', async () => {
    const link: PairLink = { scene: 'strip', pair: ['silk', 'wool'] };
    const { run, until, ends, store } = createPair(await loadFirst(), link);
    await until(({ phase }) => phase === 'ready');
    run.play();
    await until(({ timeS }) => timeS > 0.1);
    ends[1]?.('out of memory.');
    expect(store.get().problem?.what).toMatch(/by itself \(out of memory\)\. It was started again/);
    await until(({ phase }) => phase === 'ready');
    expect(store.get().timeS).toBe(0);
    ends[2]?.('out of memory');
    expect(store.get()).toMatchObject({ phase: 'stopped', playing: false });
    expect(store.get().problem?.what).toMatch(/happened twice/);
    await run.reset();
    run.play();
    await until(({ timeS }) => timeS > 0.1);
    run.pause();
  });
});
