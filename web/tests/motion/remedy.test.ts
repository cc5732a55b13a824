// What helps a setting that was refused or whose run shows nonsense, on the real module too.
import { describe, expect, it } from 'vitest';
import type { RunNumbers } from '../../src/motion/bindings/pleat-module';
import { remedyForWarning } from '../../src/motion/run/remedy';
import { presetSetting, type Setting, sceneOf } from '../../src/motion/state/setting';
import { type RunWarning, warningSentence } from '../../src/shared/bindings/run-warning';
import { fabricsText } from '../../src/shared/fabric/fabric-data';
import { isBuilt, loadModule } from '../support/built-module';

const warning = (hints: Record<string, number>): RunWarning => ({
  kind: 'stretch',
  time_s: 0.4,
  vertex: 12,
  sentence: 'from 0.4 s at vertex 12 on, the cloth stretched by up to 98 %',
  is_nonsense: true,
  hints,
});

const exploding: Setting = { ...presetSetting('curtain'), stepper: 'xpbd', substeps: 1 };

/** The numbers after a second of a setting. */
async function numbersOf(setting: Setting): Promise<RunNumbers> {
  const { Simulation } = await loadModule('pleat');
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
    expect(sentence).toContain('stretched by up to 98 %');
    expect(remedy).toEqual({ title: 'Take 4 substeps', setting: { ...exploding, substeps: 4 } });
  });

  it('says that cloth does not move so only of nonsense', () => {
    const nonsense = warning({});
    expect(warningSentence(nonsense)).toMatch(/^This is not how cloth moves: from 0.4 s/);
    const mild = {
      ...nonsense,
      is_nonsense: false,
      sentence: 'from 1 s on, steps did not converge',
    };
    expect(warningSentence(mild)).toBe('From 1 s on, steps did not converge.');
  });

  it('is Implicit where the hint is none that the page sets', () => {
    const { remedy } = remedyForWarning(warning({ '/method/step_s': 0.004 }), exploding);
    expect(remedy.setting.stepper).toBe('implicit');
  });
});

describe.runIf(isBuilt('pleat'))('the warnings of a run', () => {
  it('tell of an explosion', async () => {
    const { warnings } = await numbersOf(exploding);
    expect(warnings.map(({ kind }) => kind)).toContain('stretch');
    expect(warnings[0]?.hints['/method/substeps']).toBe(4);
  });

  it('are none for the scene as it is shipped', async () => {
    expect((await numbersOf(presetSetting('curtain'))).warnings).toEqual([]);
  });
});
