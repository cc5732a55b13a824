// Changes that may help a run that shows nonsense: their order, and on the real module that they do.
import { describe, expect, it } from 'vitest';
import { changesFor } from '../../src/motion/run/remedy-changes';
import { cheapest, tryChanges } from '../../src/motion/run/remedy-trial';
import {
  MOST_SUBSTEPS,
  presetSetting,
  type Setting,
  sceneOf,
} from '../../src/motion/state/setting';
import type { RunNumbers } from '../../src/shared/bindings/pleat-module';
import type { RunWarning } from '../../src/shared/bindings/run-warning';
import { fabricsText } from '../../src/shared/fabric/fabric-data';
import { warningSentence } from '../../src/shared/panels/warning-words';
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

describe('the warnings of a run', () => {
  it('tell of an explosion, and what was tried and holds ends it', async () => {
    const module = await loadFirst();
    const start: StartMotion = (listener) =>
      createAsked(
        workerPort<ToMotion, FromMotion>((post) => new MotionCore(module, post)),
        listener,
      );
    const [warning] = (await numbersOf(exploding, 1)).warnings;
    expect(warning?.kind).toBe('stretch');
    if (!warning) return;
    const question = { changes: () => changesFor(warning, exploding), mesh: null, warning };
    const tried = await tryChanges(start, question, new AbortController().signal);
    const best = cheapest(tried ?? []);
    expect(best?.stepMs).toBeGreaterThan(0);
    if (best) expect((await numbersOf(best.change.setting, 4)).warnings).toEqual([]);
  });

  it('are none for the scene as it is shipped', async () => {
    expect((await numbersOf(presetSetting('curtain'), 1)).warnings).toEqual([]);
  });
});
