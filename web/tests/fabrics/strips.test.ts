// Strips over an edge: each droops as the heavy elastica does, and they are sorted as it sorts them.
import { describe, expect, it } from 'vitest';
import { stripReading, stripsAnswer } from '../../src/fabrics/panels/strips-panel';
import { StripRun } from '../../src/fabrics/run/strip-run';
import { bendingLength } from '../../src/fabrics/state/bending-length';
import { namesByBendingLength, OVERHANG_M } from '../../src/fabrics/state/strips';
import { initialStripsState, sortedStrips } from '../../src/fabrics/state/strips-state';
import { fabricNamed, fabrics } from '../../src/shared/fabric/fabric-data';
import { createStore } from '../../src/shared/state/store';
import { createAsked } from '../../src/shared/workers/asked';
import type { StartMotion } from '../../src/shared/workers/motion-client';
import { MotionCore } from '../../src/shared/workers/motion-core';
import type { FromMotion, ToMotion } from '../../src/shared/workers/motion-protocol';
import { loadFirst } from '../support/built-module';
import { workerPort } from '../support/worker-port';

/**
 * Droop of the heavy elastica from end to end [degrees], `load` = w L^3/B. With p the angle from straight
 * down and t the way from the tip in lengths, p'' = load t sin p, p' = 0 at the tip, p = pi/2 at the edge:
 * bisection of p at the tip, fourth-order Runge-Kutta steps.
 */
function elasticaDroop(load: number): number {
  const N = 2000;
  function shoot(tip: number) {
    let [p, slope, across, up] = [tip, 0, 0, 0];
    for (let step = 0; step < N && p <= Math.PI / 2; ++step) {
      const h = 1 / N;
      const t = step * h;
      const bend = (time: number, angle: number) => load * time * Math.sin(angle);
      const [k1, l1] = [slope, bend(t, p)];
      const [k2, l2] = [slope + (h / 2) * l1, bend(t + h / 2, p + (h / 2) * k1)];
      const [k3, l3] = [slope + (h / 2) * l2, bend(t + h / 2, p + (h / 2) * k2)];
      const [k4, l4] = [slope + h * l3, bend(t + h, p + h * k3)];
      const middle = p + (h / 2) * k2;
      const next = p + (h / 6) * (k1 + 2 * k2 + 2 * k3 + k4);
      across += (h / 6) * (Math.sin(p) + 4 * Math.sin(middle) + Math.sin(next));
      up += (h / 6) * (Math.cos(p) + 4 * Math.cos(middle) + Math.cos(next));
      slope += (h / 6) * (l1 + 2 * l2 + 2 * l3 + l4);
      p = next;
    }
    return { p, across, up };
  }
  let [low, high] = [1e-9, Math.PI / 2];
  for (let round = 0; round < 100; ++round) {
    const middle = (low + high) / 2;
    if (shoot(middle).p < Math.PI / 2) low = middle;
    else high = middle;
  }
  const { across, up } = shoot(low);
  return (180 / Math.PI) * Math.atan2(up, across);
}

const rightDroop = (name: string) =>
  elasticaDroop((OVERHANG_M / bendingLength(fabricNamed(name))) ** 3);

/** All strips in this thread, until they rest. */
async function run(start: StartMotion) {
  const store = createStore(initialStripsState());
  let nFrames = 0;
  const strips = new StripRun(
    store,
    {
      showStrip: () => undefined,
      showFrame: () => {
        nFrames += 1;
      },
    },
    start,
  );
  strips.go();
  const until = async (test: () => boolean) => {
    while (!test()) await new Promise((resume) => setTimeout(resume, 2));
  };
  return { store, strips, until, nFrames: () => nFrames };
}

const starter = async (): Promise<StartMotion> => {
  const module = await loadFirst();
  return (listener) =>
    createAsked(
      workerPort<ToMotion, FromMotion>((post) => new MotionCore(module, post)),
      listener,
    );
};

describe('the elastica of this test', () => {
  it.each([
    [8, 41.49],
    [1, (180 / Math.PI) * Math.atan2(0.123471402, 0.9912463953)],
    [100, (180 / Math.PI) * Math.atan2(0.9375239354, 0.1592233826)],
  ])('droops under a load of %f by %f degrees', (load, droop) => {
    expect(elasticaDroop(load)).toBeCloseTo(droop, 1);
  });
});

describe('strips over an edge', () => {
  it('droop as the elastica does, and are sorted so, all fifteen', { timeout: 60000 }, async () => {
    const { store, until } = await run(await starter());
    await until(() => store.get().phase !== 'running');
    const state = store.get();
    expect(state.problem).toBeNull();
    expect(state.phase).toBe('done');
    for (const { name_en: name } of fabrics)
      expect(Math.abs((state.droops[name] ?? 99) - rightDroop(name)), name).toBeLessThan(1);
    const right = fabrics.map(({ name_en: name }) => name);
    right.sort((a, b) => rightDroop(a) - rightDroop(b));
    expect(sortedStrips(state)).toEqual(right);
    expect(namesByBendingLength()).toEqual(right);
    expect(stripsAnswer(state)).toMatch(
      /^canvas droops least, by ~\d+°; chiffon most, by ~\d+°\.$/,
    );
    const [least, most] = [right[0] ?? '', right.at(-1) ?? ''];
    expect((state.droops[most] ?? 0) - (state.droops[least] ?? 0)).toBeGreaterThan(40);
  });

  it('stay as they are when stopped, and the others follow when asked', {
    timeout: 60000,
  }, async () => {
    const { store, strips, until, nFrames } = await run(await starter());
    await until(() => Object.keys(store.get().droops).length === 2);
    strips.stop();
    expect(store.get().phase).toBe('stopped');
    const before = { ...store.get().droops };
    const frames = nFrames();
    await new Promise((resume) => setTimeout(resume, 100));
    expect(nFrames()).toBe(frames);
    expect(store.get().droops).toEqual(before);
    expect(stripsAnswer(store.get())).toBe('2 of 15 strips rest.');
    strips.go();
    await until(() => store.get().phase === 'done');
    expect(store.get().droops).toMatchObject(before);
  });

  it('go on with another worker when theirs ends, and say so', { timeout: 60000 }, async () => {
    const start = await starter();
    let end: ((reason: string) => void) | undefined;
    const { store, until } = await run((listener) => {
      end = listener.broken;
      return start(listener);
    });
    await until(() => Object.keys(store.get().droops).length === 3);
    end?.('the browser ended it without a word');
    expect(store.get().problem?.what).toMatch(/ended by itself .*started again/);
    await until(() => store.get().phase === 'done');
    expect(Object.keys(store.get().droops)).toHaveLength(15);
  });

  it('says that it cannot be computed where no worker ever starts', async () => {
    const { store } = await run(({ broken }) => {
      queueMicrotask(() => broken?.('no program'));
      return { ask: () => new Promise(() => undefined), tell() {}, terminate() {} };
    });
    await new Promise((resume) => setTimeout(resume, 10));
    expect(store.get().phase).toBe('broken');
    expect(store.get().problem?.what).toMatch(/WebAssembly/);
  });

  it('tells the numbers that the run takes', () => {
    expect(stripReading('wool', 33.2)).toMatch(/ ~78 µN·m .* 480 g\/m² .* ~26 mm\. .* ~33°/);
  });
});
