// While a hand holds cloth, and until it has calmed down, no warning comes, in settings that are warned of by themselves.
import { describe, expect, it } from 'vitest';
import type { RunNumbers } from '../../src/shared/bindings/pleat-module';
import { loadFirst } from '../support/built-module';
import { begin, STEPS_PER_SECOND, sceneOf } from '../support/scene-run';

/** Cloth is looked at again so long after a hand let go [s] (kUntilCalm of wasm/page_run.cpp). */
const UNTIL_CALM_S = 1;

/** A run in a setting that stretches the cloth too much, and what it is warned of. */
const SETTINGS = [
  { scene: 'curtain', level: 2, stepper: 'pbd', iterations: 10, kind: 'stretch' },
  { scene: 'curtain', level: 2, stepper: 'hpbd', iterations: 2, kind: 'stretch' },
  { scene: 'tablecloth', level: 1, stepper: 'pbd', iterations: 4, kind: 'stretch' },
  { scene: 'swinging_sheet', level: 1, stepper: 'pbd', iterations: 10, kind: 'soft' },
];

async function opened({ scene, level, stepper, iterations }: (typeof SETTINGS)[number]) {
  const step_s = 1 / STEPS_PER_SECOND;
  const method = { stepper, step_s, substeps: 1, iterations };
  const module = await loadFirst();
  const { rest, simulation } = begin(module, { ...sceneOf(scene), refinement: { level }, method });
  const kinds = new Set<string>();
  const run = (seconds: number) => {
    for (let step = 0; step < Math.round(seconds * STEPS_PER_SECOND); ++step) {
      expect(simulation.step(1)).toBe(0);
      const { warnings } = JSON.parse(simulation.numbers()) as RunNumbers;
      for (const { kind } of warnings) kinds.add(kind);
    }
    return [...kinds];
  };
  return { rest, simulation, run };
}

describe('a warning of cloth that stretches too much', { timeout: 60000 }, () => {
  it.each(SETTINGS)('comes of $scene by $stepper untouched: $kind', async (setting) => {
    const { simulation, run } = await opened(setting);
    expect(run(1)).toContain(setting.kind);
    simulation.delete();
  });

  it.each(SETTINGS)('does not come of a hand at $scene by $stepper', async (setting) => {
    const { rest, simulation, run } = await opened(setting);
    const at = rest[Math.floor(rest.length / 2)] ?? { id: 0, x: 0, y: 0, z: 0 };
    simulation.grab(at.id);
    simulation.moveGrab(at.x + 0.5, at.y + 0.5, at.z + 0.5);
    expect(run(1)).toEqual([]);
    simulation.releaseGrab();
    expect(run(UNTIL_CALM_S)).toEqual([]);
    simulation.delete();
  });

  it('that the cloth is softer than its fabric does not come after a hand at all', async () => {
    const [setting] = SETTINGS.filter(({ kind }) => kind === 'soft');
    if (!setting) throw new Error('no setting is warned of so');
    const { rest, simulation, run } = await opened(setting);
    simulation.grab(rest.length - 1);
    run(0.2);
    simulation.releaseGrab();
    expect(run(UNTIL_CALM_S + 2)).not.toContain('soft');
    simulation.delete();
  });
});
