// Estimate of the time of a step of many substeps, from a few of them.
import { afterEach, describe, expect, it, vi } from 'vitest';
import { foretellSteps, probeStep } from '../../src/motion/run/step-probe';
import { decodeMotionLink } from '../../src/motion/state/motion-link';
import { initialMotionState, type MotionState } from '../../src/motion/state/motion-state';
import { presetSetting, type Setting, sceneOf, withStepper } from '../../src/motion/state/setting';
import { costText, stepCostAt, withCost } from '../../src/motion/state/step-cost';
import { fabricsText } from '../../src/shared/fabric/fabric-data';
import { createStore } from '../../src/shared/state/store';
import { createAsked } from '../../src/shared/workers/asked';
import { MotionCore } from '../../src/shared/workers/motion-core';
import type { FromMotion, ToMotion } from '../../src/shared/workers/motion-protocol';
import { loadFirst } from '../support/built-module';
import { type Method, trialWorkers } from '../support/trial-worker';
import { workerPort } from '../support/worker-port';

const explicit: Setting = { ...withStepper(presetSetting('tablecloth'), 'explicit'), level: 1 };
const summaryOf = (substeps: number) => ({ substeps }) as NonNullable<MotionState['summary']>;

/** A page at a link, whose stand-in takes half a millisecond a substep. */
function open(hash: string) {
  const { link } = decodeMotionLink(hash);
  const store = createStore<MotionState>({ ...initialMotionState(link, []), phase: 'ready' });
  const workers = trialWorkers(({ substeps = 0 }: Method) => ({ stepMs: substeps / 2 }));
  foretellSteps(store, workers.start);
  const cost = () => stepCostAt(store.get().costs, link.setting, link.setting.level);
  return { store, cost, setting: link.setting, ...workers };
}

afterEach(() => vi.useRealTimers());

describe('the cost of many substeps', () => {
  it('is foretold from a few of the same length, and told as an estimate', async () => {
    const { store, cost, tried, alive, setting } = open(
      '#scene=tablecloth&level=0&stepper=explicit',
    );
    store.set({ summary: summaryOf(10000) });
    await vi.waitUntil(() => cost());
    expect(cost()).toMatchObject({ isMeasured: false, isLeast: false });
    expect(cost()?.ms).toBeCloseTo(5000, 6);
    const known = cost();
    if (known) expect(costText(known)).toBe('≈ 5 s');
    const [{ step_s = 0, substeps = 0 } = {}] = tried;
    expect(step_s / substeps).toBeCloseTo(setting.stepS / 10000, 12);
    expect(alive()).toBe(0);
  });

  it('is not measured where a step was, nor for few substeps, nor once the setting is another', async () => {
    const { store, tried, setting } = open('#scene=tablecloth&level=0&stepper=explicit');
    const rest = () => new Promise((resume) => setTimeout(resume, 400));
    store.set({ summary: summaryOf(40) });
    await rest();
    store.set({ costs: withCost({}, setting, 12), summary: summaryOf(10000) });
    await rest();
    store.set({ costs: {}, summary: summaryOf(10000) });
    store.set({ phase: 'loading', setting: withStepper(setting, 'implicit') });
    await rest();
    expect(tried).toEqual([]);
  });

  it('is within a factor of two of what a step takes in the WebAssembly module', async () => {
    const module = await loadFirst();
    const simulation = new module.Simulation(fabricsText);
    const { summary } = JSON.parse(simulation.load(JSON.stringify(sceneOf(explicit))));
    expect(summary.substeps).toBeGreaterThan(100);
    const port = workerPort<ToMotion, FromMotion>((post) => new MotionCore(module, post));
    const content = { setting: explicit, mesh: null };
    const foretold = await probeStep(createAsked(port), content, summary.substeps);
    simulation.step(3);
    const { steps_ms, steps_timed } = JSON.parse(simulation.numbers());
    simulation.delete();
    const ratio = Number(foretold) / (steps_ms / steps_timed);
    expect(ratio).toBeGreaterThan(0.5);
    expect(ratio).toBeLessThan(2);
  });
});
