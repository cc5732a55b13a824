// What helps a setting that was refused or whose run shows nonsense, on the real module too.
import { describe, expect, it } from 'vitest';
import { remedyForWarning } from '../../src/motion/run/remedy';
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
import { loadFirst } from '../support/built-module';

const warning = (hints: Record<string, unknown>): RunWarning => ({
  kind: 'stretch',
  time_s: 0.4,
  vertex: 12,
  value: 0.98,
  bound: 0.35,
  sentence: 'as the command says it',
  is_nonsense: true,
  hints,
});

const exploding: Setting = { ...presetSetting('curtain'), stepper: 'xpbd', substeps: 1 };

/** The numbers after a second of a setting. */
async function numbersOf(setting: Setting): Promise<RunNumbers> {
  const { Simulation } = await loadFirst();
  const simulation = new Simulation(fabricsText);
  try {
    expect(JSON.parse(simulation.load(JSON.stringify(sceneOf(setting, null))))).toMatchObject({
      ok: true,
    });
    for (let frame = 0; frame < 60; ++frame) simulation.step(1);
    return JSON.parse(simulation.numbers());
  } finally {
    simulation.delete();
  }
}

describe('the remedy for nonsense', () => {
  it('is the value that the core hints at', () => {
    const { sentence, remedy } = remedyForWarning(warning({ '/method/substeps': 4 }), exploding);
    expect(sentence).toMatch(
      /^The cloth stretches too much: .* by up to 98 %.* The computer looks too rarely/,
    );
    expect(remedy).toEqual({
      title: 'Start again with 4 substeps',
      setting: { ...exploding, substeps: 4 },
      startsAnew: true,
    });
  });

  it('is the first hint, and none that is at its most', () => {
    const both = warning({ '/method/substeps': 4, '/method/iterations': 4 });
    expect(remedyForWarning(both, exploding).remedy.setting.substeps).toBe(4);
    const most = { ...exploding, substeps: MOST_SUBSTEPS };
    const beyond = warning({ '/method/substeps': 4 * MOST_SUBSTEPS, '/method/iterations': 4 });
    expect(remedyForWarning(beyond, most).remedy.setting).toEqual({ ...most, iterations: 4 });
  });

  it('is another method with its own counts', () => {
    const method = { stepper: 'implicit', step_s: 1 / 60, substeps: 4 };
    const { title, setting } = remedyForWarning(warning({ '/method': method }), exploding).remedy;
    expect(title).toBe('Start again with Implicit in 4 substeps');
    expect(setting).toMatchObject({ stepper: 'implicit', substeps: 4, iterations: 1 });
  });

  it('says that a run has exploded only of nonsense', () => {
    const nonsense = warning({});
    expect(warningSentence({ ...nonsense, value: 4e10 })).toContain('many times its length');
    expect(warningSentence({ ...nonsense, value: null })).toContain('many times its length');
    const mild: RunWarning = {
      ...nonsense,
      kind: 'not_converged',
      is_nonsense: false,
      value: 1e-5,
    };
    expect(warningSentence(mild)).toBe(
      'Steps did not converge: from 0.40 s on they left 0.0010 % of their equations unsolved.',
    );
    expect(remedyForWarning(mild, exploding).sentence).toBe(warningSentence(mild));
  });

  it('is Implicit where the hint is none that the page sets', () => {
    const { remedy } = remedyForWarning(warning({ '/method/step_s': 0.004 }), exploding);
    expect(remedy.setting.stepper).toBe('implicit');
  });
});

describe('the warnings of a run', () => {
  it('tell of an explosion, and what they advise ends it', async () => {
    const [first] = (await numbersOf(exploding)).warnings;
    expect(first?.kind).toBe('stretch');
    if (!first) return;
    const { setting } = remedyForWarning(first, exploding).remedy;
    expect((await numbersOf(setting)).warnings).toEqual([]);
  });

  it('are none for the scene as it is shipped', async () => {
    expect((await numbersOf(presetSetting('curtain'))).warnings).toEqual([]);
  });
});
