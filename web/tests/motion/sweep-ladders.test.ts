// The references that are shipped for sweeps are those that the page asks for, in WebAssembly too.
import { readdirSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { type PresetId, presetSetting, withModel } from '../../src/motion/state/setting';
import {
  FINEST_SHIPPED,
  FINEST_SWEEP,
  type ReferenceKind,
  sweepPlan,
} from '../../src/motion/state/sweep-plan';
import { fabricsText } from '../../src/shared/fabric/fabric-data';
import { loadFirst } from '../support/built-module';

const FOLDER = new URL('../../../assets/references/sweep/', import.meta.url);

const shippedFor = (preset: string) =>
  readdirSync(new URL(`${preset.replaceAll('-', '_')}/`, FOLDER)).map((name) =>
    name.replace('.reference', ''),
  );

async function wantedIds(plan: object): Promise<string[]> {
  const { Experiment } = await loadFirst();
  const experiment = new Experiment(fabricsText);
  try {
    return JSON.parse(experiment.start(JSON.stringify(plan))).references;
  } finally {
    experiment.delete();
  }
}

/** References that the sweeps of a preset as it is ask for, up to a level. */
async function wantedUpTo(preset: PresetId, most: number, reference: ReferenceKind) {
  const wanted = new Set<string>();
  for (const withSlow of [false, true])
    for (let finest = 1; finest <= most; ++finest) {
      const wish = { finest, withSlow };
      const plan = sweepPlan(presetSetting(preset), wish, null, reference);
      for (const id of await wantedIds(plan)) wanted.add(id);
    }
  return [...wanted].sort();
}

describe('the references of sweeps', () => {
  it('are all there for the swinging sheet, on a finer mesh too', async () => {
    const wanted = await wantedUpTo('swinging-sheet', FINEST_SWEEP, 'converged');
    expect(shippedFor('swinging-sheet').sort()).toEqual(wanted);
    expect(wanted.filter((id) => id.startsWith('converged-'))).toHaveLength(1);
    expect(FINEST_SHIPPED['swinging-sheet']).toBe(FINEST_SWEEP);
  });

  it.each(['curtain', 'tablecloth'] as const)(
    'are those of the own meshes for the %s',
    async (preset) => {
      const wanted = await wantedUpTo(preset, FINEST_SHIPPED[preset] ?? -1, 'same_mesh');
      expect(shippedFor(preset).sort()).toEqual(wanted);
    },
  );

  it('are of no other fabric or model', async () => {
    const own = presetSetting('swinging-sheet');
    for (const other of [{ ...own, fabric: 'silk' }, withModel(own, 'membrane')]) {
      const ids = await wantedIds(sweepPlan(other, { finest: 1, withSlow: false }));
      for (const id of ids) expect(shippedFor('swinging-sheet')).not.toContain(id);
    }
  });
});
