// Settings that nobody has touched hold: each scene with each stepper that sweeps, on the module as it is built.
import { describe, expect, it } from 'vitest';
import { leastSubsteps } from '../../src/motion/state/least-substeps';
import { decodeMotionLink } from '../../src/motion/state/motion-link';
import {
  levelNeed,
  levelsOf,
  modelsOf,
  PRESET_IDS,
  presetSetting,
  type Setting,
  sceneOf,
  withLevel,
  withStepper,
} from '../../src/motion/state/setting';
import { stepCostAt, withCost } from '../../src/motion/state/step-cost';
import type { RunNumbers } from '../../src/shared/bindings/pleat-module';
import { fabricsText } from '../../src/shared/fabric/fabric-data';
import { STEPPERS, stepperRow } from '../../src/shared/steppers/steppers';
import { loadFirst } from '../support/built-module';

const SWEEPING = STEPPERS.filter((row) => row.settings.iterations && !row.solves_whole_substeps);

/** All that have springs; a flag has 60 cells at level 2, as many as others have at level 3. */
const SPRUNG = PRESET_IDS.filter((id) => modelsOf(id).includes('springs'));

/** `./pleat bench page_truth --only untouched` goes on for longer, and to finer levels. */
const SECONDS = 1;
const FINEST = 2;

/** Nonsense that a run shows, with its time. */
async function nonsenseOf(setting: Setting): Promise<string[]> {
  const { Simulation } = await loadFirst();
  const simulation = new Simulation(fabricsText);
  try {
    expect(JSON.parse(simulation.load(JSON.stringify(sceneOf(setting))))).toMatchObject({
      ok: true,
    });
    simulation.step(Math.round(SECONDS / setting.stepS));
    const { warnings } = JSON.parse(simulation.numbers()) as RunNumbers;
    return warnings.filter((warning) => warning.is_nonsense).map(({ sentence }) => sentence);
  } finally {
    simulation.delete();
  }
}

describe('settings that nobody has touched', () => {
  it.each(SPRUNG)('hold: %s', { timeout: 120000 }, async (preset) => {
    const told: Record<string, string[]> = {};
    for (const { name } of SWEEPING)
      for (const level of levelsOf(preset).filter((one) => one <= FINEST)) {
        const setting = withLevel(withStepper(presetSetting(preset), name), level);
        const nonsense = levelNeed(setting, level) ? [] : await nonsenseOf(setting);
        if (nonsense.length > 0) told[`${name} ${level}`] = nonsense;
      }
    expect(told).toEqual({});
  });

  it.each(['curtain', 'tablecloth'] as const)(
    'hold by their substeps: with a single one the %s does not',
    { timeout: 120000 },
    async (preset) => {
      for (const name of ['xpbd', 'pbd']) {
        const setting = withStepper(presetSetting(preset), name);
        expect(setting.substeps, name).toBeGreaterThan(1);
        expect(await nonsenseOf({ ...setting, substeps: 1 }), name).not.toEqual([]);
      }
    },
  );

  it('have more substeps on finer meshes and in longer steps, with steppers that sweep', () => {
    const pbd = stepperRow('pbd');
    expect([8, 16, 32, 64].map((n) => leastSubsteps(pbd, n, 1 / 60))).toEqual([4, 7, 13, 26]);
    expect(leastSubsteps(pbd, 64, 1 / 120)).toBe(13);
    expect(leastSubsteps(stepperRow('hpbd'), 64, 1 / 60)).toBe(8);
    for (const { name } of STEPPERS.filter((row) => !SWEEPING.includes(row)))
      expect(leastSubsteps(stepperRow(name), 128, 1 / 60)).toBe(1);
  });

  it('stay what a visitor chose when the level changes, and are of the link’s level', () => {
    const own = withStepper(presetSetting('curtain'), 'pbd');
    expect([own.substeps, withLevel(own, 3).substeps]).toEqual([13, 26]);
    expect(withLevel({ ...own, substeps: 5 }, 3)).toEqual({ ...own, substeps: 5, level: 3 });
    expect(withLevel(withLevel(own, 4), 2)).toEqual(own);
    const { link } = decodeMotionLink('#scene=curtain&stepper=pbd&level=3');
    expect(link.setting).toEqual(withLevel(own, 3));
    const implicit = presetSetting('curtain');
    expect(withLevel(implicit, 4)).toEqual({ ...implicit, level: 4 });
    expect(withStepper(presetSetting('wind'), 'multigrid')).toEqual(presetSetting('wind'));
  });

  it('are told to cost what their substeps do', () => {
    const own = withStepper(presetSetting('curtain'), 'pbd');
    const cost = stepCostAt(withCost({}, own, 6), own, 3);
    expect(cost?.ms).toBeCloseTo(6 * 4 * 2, 9);
  });
});
