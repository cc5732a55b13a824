import { afterEach, describe, expect, it, vi } from 'vitest';
import { planSweep } from '../../src/motion/run/sweep-references';
import { presetSetting } from '../../src/motion/state/setting';
import { type ReferenceKind, sweepPlan } from '../../src/motion/state/sweep-plan';
import { SweepCore } from '../../src/motion/worker/sweep-core';
import type { FromSweep, PlannedMessage, ToSweep } from '../../src/motion/worker/sweep-protocol';
import { createAsked, type Done } from '../../src/shared/workers/asked';
import { createFakeModule } from '../support/fake-module';
import { stubLocks } from '../support/locks';
import { workerPort } from '../support/worker-port';

const files = vi.hoisted(() => new Map<string, string>());
vi.mock('../../src/motion/run/ladder-files', () => ({ LADDER_FILES: files }));

interface Answers {
  plan: PlannedMessage;
  keep: Done;
  measure: Done;
}

/** A worker with the stand-in, and what it was told. */
function startWorker() {
  const told: ToSweep[] = [];
  const port = workerPort<ToSweep, FromSweep>((post) => {
    const core = new SweepCore(createFakeModule().module, post);
    return {
      receive(message) {
        told.push(message);
        core.receive(message);
      },
    };
  });
  return { told, worker: createAsked<ToSweep, Answers>(port) };
}

/** Shipped files by their ids, and what a fetch of each brings; null: it fails. */
function ship(shipped: Record<string, string | null>): string[] {
  const asked: string[] = [];
  files.clear();
  for (const id of Object.keys(shipped)) files.set(id, `at/${id}`);
  vi.stubGlobal('fetch', async (url: string) => {
    asked.push(url);
    const text = shipped[url.replace('at/', '')];
    if (!text) throw new TypeError('no connection');
    return new Response(text);
  });
  return asked;
}

const planOf = (reference: ReferenceKind) =>
  sweepPlan(presetSetting('curtain'), { finest: 1, withSlow: false }, null, reference);

const referencesOf = (told: readonly ToSweep[]) =>
  told.flatMap((one) => (one.type === 'plan' ? JSON.parse(one.planText).reference : []));

describe('planning a sweep', () => {
  stubLocks();
  afterEach(() => vi.unstubAllGlobals());

  it('fetches what its rows are compared with and hands it over', async () => {
    const { told, worker } = startWorker();
    const asked = ship({ converged: 'converged', 'own-0': 'own-0', 'of-another-scene': 'other' });
    expect(await planSweep(worker, planOf)).toBe('known');
    expect(asked).toEqual(['at/converged', 'at/own-0']);
    expect(referencesOf(told)).toEqual(['converged']);
    const kept = told.flatMap((one) => (one.type === 'keep' ? one.references : []));
    expect(kept.map((bytes) => new TextDecoder().decode(bytes))).toEqual(['converged', 'own-0']);
  });

  it.each([
    ['unshipped', {}],
    ['unshipped', { 'own-0': 'own-0' }],
    ['unfetched', { converged: null, 'own-0': 'own-0' }],
    ['unfetched', { converged: '<html>', 'own-0': 'own-0' }],
  ] as const)('falls back to the own mesh where they are %s: %j', async (meshError, shipped) => {
    const { told, worker } = startWorker();
    ship(shipped);
    expect(await planSweep(worker, planOf)).toBe(meshError);
    expect(referencesOf(told)).toEqual(['converged', 'same_mesh']);
  });

  it('hands over what there is of the own meshes', async () => {
    const { told, worker } = startWorker();
    ship({ 'own-0': 'own-0' });
    await planSweep(worker, planOf);
    const kept = told.flatMap((one) => (one.type === 'keep' ? one.references : []));
    expect(kept.map((bytes) => new TextDecoder().decode(bytes))).toEqual(['own-0']);
  });

  it('falls back where the finer mesh would be too large, and fails where the scene is at fault', async () => {
    ship({});
    const bad = { ...planOf('converged'), settings: [] };
    const { worker } = startWorker();
    const onlyOwn = (kind: ReferenceKind) => (kind === 'converged' ? bad : planOf(kind));
    expect(await planSweep(worker, onlyOwn)).toBe('unshipped');
    await expect(planSweep(worker, () => bad)).rejects.toThrow('expected a setting');
  });
});
