// The page's end of the worker of deformed cloth: what it shows is what the worker has.
import { beforeAll, describe, expect, it, vi } from 'vitest';
import type { StartDeform } from '../../src/fabrics/run/deform-client';
import { Deformer } from '../../src/fabrics/run/deformer';
import { BORNE, reachOf, restEdges } from '../../src/fabrics/state/edge-reach';
import { geometryOf } from '../../src/fabrics/state/fabric-geometry';
import { decodeFabricsLink, encodeFabricsLink } from '../../src/fabrics/state/fabrics-link';
import { initialFabricsState } from '../../src/fabrics/state/fabrics-state';
import { joined } from '../../src/fabrics/state/holds';
import { DeformCore } from '../../src/fabrics/worker/deform-core';
import type { FromDeform, ToDeform } from '../../src/fabrics/worker/deform-protocol';
import { deformedMesh, holdFor } from '../../src/motion/state/obj-mesh';
import { presetSetting, sceneOf } from '../../src/motion/state/setting';
import { frameViews } from '../../src/shared/bindings/frame';
import { fabricNamed, fabricsText } from '../../src/shared/fabric/fabric-data';
import type { StartShape } from '../../src/shared/page/view';
import { createStore } from '../../src/shared/state/store';
import { createAsked } from '../../src/shared/workers/asked';
import { type BuiltModule, loadModule } from '../support/built-module';
import { workerPort } from '../support/worker-port';

// The worker is a core in this thread. Messages to it and from it come later and in their order.
let module: BuiltModule;
let end: ((reason: string) => void) | undefined; // ends the worker that was started last
const start: StartDeform = (listener) => {
  end = listener.broken;
  return createAsked(
    workerPort<ToDeform, FromDeform>((post) => {
      const core = new DeformCore(module, post, {
        later: () => setTimeout(() => core.advance(), 0),
        nowMs: () => performance.now(),
      });
      return core;
    }),
    listener,
  );
};

/** The view's state at a link, with the frame of its first pane. */
async function open(hash: string) {
  const { link, problems } = decodeFabricsLink(hash);
  const store = createStore(initialFabricsState(link, problems));
  let positions = new Float32Array(0);
  let onFrame: () => void = () => undefined;
  const deformer = new Deformer(
    store,
    {
      showMesh: () => undefined,
      showFrame(pane, buffer) {
        if (pane === 0) positions = frameViews(buffer).positions.slice();
        onFrame();
      },
    },
    start,
  );
  /** Waits until everything that was asked for is answered and every shape is found. */
  async function found() {
    await new Promise((resume) => setTimeout(resume, 30));
    await vi.waitUntil(() => {
      const { phase, panes, isDragging } = store.get();
      const isDone = panes.every(({ status }) => /converged/.test(status));
      return phase === 'ready' && isDone && !isDragging;
    }, 20000);
  }
  deformer.openExperiment(link.experiment, link);
  await found();
  return {
    store,
    deformer,
    found,
    /** Largest distance of a held vertex from where the page says that it is held [m]. */
    offHold() {
      const { vertices, places } = joined(store.get().holds);
      const off = (at: number, k: number) => Math.abs((positions[at] ?? 9) - (places[k] ?? 0));
      return Math.max(
        0,
        ...[...vertices].flatMap((v, i) => [0, 1, 2].map((k) => off(3 * v + k, 3 * i + k))),
      );
    },
    atNextFrame(work: () => void) {
      onFrame = () => {
        onFrame = () => undefined;
        work();
      };
    },
  };
}

/** The edges of a start shape, as they are there and over what they are at rest. */
function startReach({ section, positions }: StartShape) {
  const { mesh } = section as { mesh: { positions_m: number[][]; triangles: number[][] } };
  const edges = restEdges(Uint32Array.from(mesh.triangles.flat()), mesh.positions_m.flat());
  return reachOf(edges, positions);
}

/** Kinds of the warnings of half a second of motion from there. */
function warningsFrom(shape: StartShape, fabric: string): string[] {
  const mesh = deformedMesh(shape);
  const setting = { ...presetSetting('obj'), fabric, hold: holdFor(mesh, 'group:held') };
  const run = new module.Simulation(fabricsText);
  expect(JSON.parse(run.load(JSON.stringify(sceneOf(setting, mesh)))).ok).toBe(true);
  expect(JSON.parse(run.startFrom(shape.positions)).ok).toBe(true);
  run.step(30);
  const { warnings } = JSON.parse(run.numbers()) as { warnings: { kind: string }[] };
  run.delete();
  return warnings.map(({ kind }) => kind);
}

const SCENE = '#view=fabrics&scene=terms&fabrics=wool';
const NO_RECOVERY = { recovery: false, stretch: true, bending: true };

describe('deformer', () => {
  beforeAll(async () => {
    vi.stubGlobal('window', globalThis);
    module = await loadModule();
  });

  it('keeps what was moved by hand where it is when a later release is refused', async () => {
    const { store, deformer, found, offHold } = await open(`${SCENE}&terms=stretch+bending`);
    for (const { name } of store.get().pins) deformer.release(name);
    await found();
    deformer.nudge('middle', [0, 0.1, 0]);
    await found();
    deformer.release('middle');
    await found();
    const { holds, problem } = store.get();
    expect(problem?.what).toMatch(/^Undone: .* Expected .*singular\.$/);
    expect(holds.find(({ name }) => name === 'middle')?.offset).toEqual([0, 0.1, 0]);
    expect(offHold()).toBeLessThan(1e-6);
  });

  it('shows what holds the cloth after several changes that were refused at once', async () => {
    const { store, deformer, found, offHold } = await open(`${SCENE}&terms=stretch+bending`);
    for (const { name } of store.get().holds) deformer.release(name);
    deformer.release('middle');
    await found();
    expect(store.get().holds.map(({ name }) => name)).toContain('middle');
    expect(offHold()).toBeLessThan(1e-6);
    deformer.resetHolds();
    await found();
    expect(offHold()).toBeLessThan(1e-6);
  });

  it('goes back to the terms that could be shown, though a frame came before the answer', async () => {
    const { store, deformer, found, atNextFrame } = await open(SCENE);
    atNextFrame(() => store.set({ terms: NO_RECOVERY }));
    for (const { name } of store.get().holds) deformer.release(name);
    await vi.waitUntil(() => store.get().problem !== null, 20000);
    await found();
    expect(store.get().terms.recovery).toBe(true);
    expect(store.get().problem?.what).toMatch(/singular/);
  });

  it('shows all terms where those of a link leave no one shape', async () => {
    const all = 'upper-left;upper-right;lower-left;lower-right;middle';
    const { store } = await open(`${SCENE}&terms=stretch&free=${all}`);
    const { holds, terms, problem } = store.get();
    expect(holds).toEqual([]);
    expect(terms.recovery).toBe(true);
    expect(problem?.what).toMatch(/singular/);
  });

  it('has the measurements of the weights that are shown in its link', async () => {
    const { measures } = geometryOf(fabricNamed('wool'));
    const { store, deformer, found } = await open(
      '#view=fabrics&scene=terms&fabrics=own:0.97,1.05,0.99',
    );
    deformer.measure(measures);
    await found();
    const { panes, ownFabric } = store.get();
    expect(panes[0]?.weights).toEqual(ownFabric?.weights);
    expect(panes[0]?.fabric).toEqual({ kind: 'own', measures });
    const { recovery, stretch, bending } = measures;
    expect(encodeFabricsLink(store.get())).toContain(`own:${recovery},${stretch},${bending}&`);
  });

  it('shows the same with another worker when its own ends, and goes on', async () => {
    const { store, deformer, found, offHold } = await open(SCENE);
    deformer.nudge('middle', [0, 0.1, 0]);
    await found();
    const { cloth } = store.get();
    end?.('the browser ended it without a word');
    deformer.nudge('middle', [0, 0.2, 0]); // the new one has no cloth yet
    expect(store.get().phase).toBe('loading');
    await found();
    const { holds, problem, panes } = store.get();
    expect(store.get().cloth).not.toBe(cloth);
    expect(problem?.what).toMatch(/^The computation ended by itself \(the browser .*started again/);
    expect(holds.find(({ name }) => name === 'middle')?.offset).toEqual([0, 0.1, 0]);
    expect(panes[0]?.fabric).toEqual({ kind: 'named', name: 'wool' });
    deformer.nudge('middle', [0, 0.05, 0]);
    await found();
    expect(offHold()).toBeLessThan(1e-6);
  });

  it('holds the cloth as at first after two ends in a row, and gives up after three', async () => {
    const { store, deformer, found } = await open(SCENE);
    deformer.nudge('middle', [0, 0.1, 0]);
    await found();
    end?.('out of memory');
    end?.('out of memory');
    expect(store.get().problem?.what).toMatch(/happened twice/);
    await found();
    const middle = store.get().holds.find(({ name }) => name === 'middle');
    expect(middle?.offset).toEqual([0, 0, 0]);
    for (let ends = 0; ends < 3; ++ends) end?.('out of memory');
    expect(store.get().phase).toBe('broken');
    expect(store.get().problem?.what).toMatch(/three times/);
  });

  it('tells how far the shape it found is stretched, and nothing of one that is not found', async () => {
    const { store, deformer, found } = await open(SCENE);
    deformer.nudge('middle', [0, 0.4, 0]);
    await found();
    expect(store.get().panes[0]?.reach?.longest).toBeGreaterThan(1.1);
    deformer.resetHolds();
    expect(store.get().panes[0]?.reach).toBeNull();
  });

  it.each(['pull', 'ball', 'diagonal_stretch', 'wrinkles', 'terms'])(
    'hands over a start of %s that cloth bears, and from which it moves without a warning',
    async (id) => {
      const { store, deformer } = await open(`#view=fabrics&scene=${id}&fabrics=silk`);
      const told = store.get().panes[0]?.reach;
      const shape = await deformer.startShape();
      if (!told || !shape) throw new Error('a shape was expected');
      const { longest, shortest } = startReach(shape);
      expect(longest).toBeLessThan(BORNE + 1e-6);
      expect(shortest).toBeGreaterThan(1 / BORNE - 1e-6);
      expect(told.share).toBeGreaterThan(0);
      const isEased = told.share < 1;
      if (isEased) expect(Math.min(BORNE - longest, shortest - 1 / BORNE)).toBeCloseTo(0, 4);
      expect(shape.name.includes('eased in by')).toBe(isEased);
      expect(warningsFrom(shape, 'silk')).toEqual([]);
    },
  );

  it('hands over the very shape where cloth bears it', async () => {
    const { store, deformer } = await open(
      '#view=fabrics&scene=terms&fabrics=velvet&held=middle:0,-0.09,0',
    );
    expect(store.get().panes[0]?.reach?.share).toBe(1);
    const shape = await deformer.startShape();
    expect(shape?.name).toBe('The pulled cloth');
  });
});
