// The three panes with the real module and the frames that come with the page.
import { beforeAll, describe, expect, it } from 'vitest';
import type { RefinementModule } from '../../src/refinement/bindings/refinement-module';
import { hintedSubsteps, warningWords } from '../../src/refinement/panels/garment-words';
import type { GarmentClient } from '../../src/refinement/run/garment-client';
import type { ShownFrame } from '../../src/refinement/run/pane-set';
import { ExamplePlanner, type Progress, type Wish } from '../../src/refinement/run/planner';
import { exampleUrls } from '../../src/refinement/run/records';
import { Trio, type TrioParts } from '../../src/refinement/run/trio';
import { FIRST_PICTURE } from '../../src/refinement/state/garment-frames';
import { basePatterns, type PlanFile } from '../../src/refinement/state/plan-file';
import {
  comparedPanes,
  DEFAULT_LINK,
  initialRefinementState,
  type PaneId,
  type RefinementLink,
  type RefinementState,
} from '../../src/refinement/state/refinement-state';
import type { GarmentMesh, ToGarment } from '../../src/refinement/worker/garment-protocol';
import { frameViews } from '../../src/shared/bindings/frame';
import { createStore, type Store } from '../../src/shared/state/store';
import { loadModule } from '../support/built-module';
import {
  exampleClient,
  garmentClient,
  mortalWorkers,
  recordBytes,
} from '../support/garment-workers';

let module: RefinementModule;
beforeAll(async () => {
  module = await loadModule();
});

const PATIENCE_MS = 240000;

/** The first three frames of a further example count, instead of minutes of work. */
const SEEN = { fromS: 0, toS: 0.1 };

const plannerParts = () => new ExamplePlanner(() => exampleClient(module), recordBytes, SEEN);

/** Panes that are pulled down a hundred thousand times as much as on earth. */
function heavy(questions: ToGarment[]): GarmentClient {
  const client = garmentClient(module, questions);
  const world = { gravity_m_per_s2: [0, -1e6, 0] };
  return {
    ...client,
    ask: (question, transfer) => {
      if (question.type !== 'load') return client.ask(question, transfer);
      const sceneText = JSON.stringify({ ...JSON.parse(question.sceneText), world });
      return client.ask({ ...question, sceneText }, transfer);
    },
  };
}

interface Stand {
  store: Store<RefinementState>;
  trio: Trio;
  meshes: Partial<Record<PaneId, GarmentMesh>>;
  shown: Partial<Record<PaneId, Float32Array>>;
  questions: ToGarment[];
  settled(test: (state: RefinementState) => boolean): Promise<RefinementState>;
}

function stand(link: Partial<RefinementLink> = {}, changes: Partial<TrioParts> = {}): Stand {
  const store = createStore(initialRefinementState({ ...DEFAULT_LINK, ...link }, []));
  const meshes: Stand['meshes'] = {};
  const shown: Stand['shown'] = {};
  const questions: ToGarment[] = [];
  const held: Partial<Record<PaneId, ArrayBuffer>> = {};
  const view = {
    showMesh(pane: PaneId, mesh: GarmentMesh) {
      meshes[pane] = mesh;
    },
    showFrames(frames: ShownFrame[]) {
      for (const { pane, buffer } of frames) {
        expect(buffer).not.toBe(held[pane]); // the one that is drawn until now
        held[pane] = buffer;
        shown[pane] = frameViews(buffer).positions.slice();
      }
    },
  };
  const trio = new Trio(store, view, {
    start: () => garmentClient(module, questions),
    fetchBytes: recordBytes,
    planner: plannerParts(),
    later: (callback) => setTimeout(callback, 1),
    nowMs: () => performance.now(),
    ...changes,
  });
  const settled = (test: (state: RefinementState) => boolean) =>
    new Promise<RefinementState>((resolve) => {
      const look = () => {
        if (test(store.get())) resolve(store.get());
        else setTimeout(look, 2);
      };
      look();
    });
  return { store, trio, meshes, shown, questions, settled };
}

const isReady = ({ phase }: RefinementState) => phase === 'ready';

/** The numbers, which follow the first picture, are there too. */
const isMeasured = (state: RefinementState) =>
  isReady(state) && comparedPanes(state).every((id) => state.panes[id].faults !== null);

describe('planner', () => {
  it('makes of the example the very plan that comes with the page', async () => {
    const urls = exampleUrls('skirt');
    const shipped: PlanFile = JSON.parse(
      new TextDecoder().decode(await recordBytes(urls?.plan ?? '')),
    );
    const wish: Wish = { ...DEFAULT_LINK };
    const planner = plannerParts();
    // A hair more demand is another wish, and the same mesh.
    const near = await planner.plan({ ...wish, demand: wish.demand + 0.0001 });
    expect(near.splits.map(([face]) => face)).toEqual(shipped.splits.map(([face]) => face));
    near.splits.forEach(([, loss], i) => {
      expect(loss / (shipped.splits[i]?.[1] ?? 0)).toBeCloseTo(1, 12);
    });
    near.curvature_limits_per_m.forEach((limit, pattern) => {
      expect(limit).toBeCloseTo(shipped.curvature_limits_per_m[pattern] ?? 0, 6);
    });
  });

  it('keeps a budget of vertices, nearly used up', async () => {
    const wish: Wish = { ...DEFAULT_LINK, rule: 'budget', demand: 3, budget: 2000 };
    const plan = await plannerParts().plan(wish);
    expect(plan.vertices).toBeLessThanOrEqual(2000);
    expect(plan.vertices).toBeGreaterThan(1940);
    expect(plan.curvature_limits_per_m.every((limit) => limit > 0)).toBe(true);
  });

  it('says what is wrong with a budget below the coarse mesh', async () => {
    const wish: Wish = { ...DEFAULT_LINK, rule: 'budget', demand: 3, budget: 10 };
    await expect(plannerParts().plan(wish)).rejects.toThrow('at least the base mesh');
  });
});

/** The sentence for an example that fails with the words "no room". */
const NO_ROOM = 'Not all of it could be fetched (no room). Check the connection.';

describe('further examples', () => {
  it(
    'are run, told of, merged with the one that comes with the page, and kept',
    async () => {
      const planner = plannerParts();
      const wish: Wish = { ...DEFAULT_LINK, demand: 2.5 };
      const alone = await planner.plan(wish);
      const heard: [string, number][] = [];
      const hear = (motion: string, share: number) => heard.push([motion, share]);
      const both = await planner.plan({ ...wish, further: ['squat'] }, hear);
      expect(both.examples.map(({ name }) => name)).toEqual(['skirt_walk', 'skirt_squat']);
      expect(heard.map(([motion]) => motion)).toEqual(Array(4).fill('squat'));
      expect(heard.map(([, share]) => Math.round(3 * share))).toEqual([0, 0, 1, 2]);
      const before = basePatterns(alone);
      const after = basePatterns(both);
      expect(after.every((pattern, vertex) => pattern >= (before[vertex] ?? 9))).toBe(true);
      expect(after).not.toEqual(before);
      // Another demand runs nothing.
      heard.length = 0;
      const again = await planner.plan({ ...wish, demand: 3, further: ['squat'] }, hear);
      expect([heard.length, again.examples.length]).toEqual([0, 2]);
      // Another fabric is another cloth.
      const other = await planner.plan({ ...wish, fabric: 'silk' });
      expect(other.examples.length).toBe(1);
    },
    PATIENCE_MS,
  );

  it(
    'say what is wrong with one that cannot run',
    async () => {
      const steep = new ExamplePlanner(
        () => {
          const client = exampleClient(module);
          return {
            ...client,
            ask: (question) =>
              client.ask(question.type === 'begin' ? { ...question, sceneText: '{' } : question),
          };
        },
        recordBytes,
        SEEN,
      );
      const wish: Wish = { ...DEFAULT_LINK, further: ['squat'] };
      await expect(steep.plan(wish)).rejects.toThrow(
        /^expected JSON, got an error while parsing object key/,
      );
      expect((await steep.plan({ ...wish, further: [] })).examples.length).toBe(1);
    },
    PATIENCE_MS,
  );

  /** Stays at half of any further example, or fails there. */
  function halfway(failure: Error | null) {
    const planner = plannerParts();
    return {
      cancel: () => planner.cancel(),
      async plan(wish: Wish, progress?: Progress) {
        if (wish.further.length === 0) return planner.plan(wish);
        progress?.('squat', 0.5);
        if (failure) throw failure;
        return new Promise<PlanFile>(() => undefined);
      },
    };
  }

  it(
    'are given up by cancelling, and the plan stays',
    async () => {
      const { store, trio, settled } = stand({}, { planner: halfway(null) });
      const { plan } = await settled(isReady);
      store.set({ further: ['squat'] });
      expect(store.get()).toMatchObject({
        phase: 'loading',
        doing: { share: 0.5, canCancel: true },
      });
      trio.cancel();
      expect(store.get()).toMatchObject({ phase: 'ready', doing: null, further: [], plan });
    },
    PATIENCE_MS,
  );

  it(
    'are given up when they cannot run, with a sentence',
    async () => {
      const { store, settled } = stand({}, { planner: halfway(new Error('no room')) });
      await settled(isReady);
      store.set({ further: ['squat'] });
      const state = await settled(({ problem }) => problem !== null);
      expect(state).toMatchObject({ phase: 'ready', doing: null, further: [] });
      expect(state.problem?.what).toBe(NO_ROOM);
    },
    PATIENCE_MS,
  );

  it(
    'of a link can be cancelled too, and what is left is shown',
    async () => {
      const link = { further: ['squat'] as const };
      const { store, trio, settled } = stand(link, { planner: halfway(null) });
      expect(store.get()).toMatchObject({ plan: null, doing: { share: 0.5, canCancel: true } });
      trio.cancel();
      const state = await settled(isReady);
      expect(state.further).toEqual([]);
      expect(state.plan?.examples.length).toBe(1);
    },
    PATIENCE_MS,
  );

  it(
    'of a link that cannot run leave the rest of it',
    async () => {
      const link = { further: ['squat'] as const };
      const { settled } = stand(link, { planner: halfway(new Error('no room')) });
      const state = await settled(isReady);
      expect(state.further).toEqual([]);
      expect(state.problem?.what).toBe(NO_ROOM);
    },
    PATIENCE_MS,
  );
});

describe('trio', () => {
  it(
    'shows each record as soon as it is there, before the others are',
    async () => {
      let give: () => void = () => undefined;
      const gate = new Promise<void>((resolve) => {
        give = resolve;
      });
      const fetchBytes = async (url: string) => {
        if (url.includes('fine.recording')) await gate;
        return recordBytes(url);
      };
      const { store, settled, shown } = stand({}, { fetchBytes });
      await settled(() => shown.coarse !== undefined && shown.planned !== undefined);
      expect(store.get().phase).toBe('loading');
      const early = shown.planned;
      give();
      await settled(isReady);
      expect(shown.planned).toEqual(early);
    },
    PATIENCE_MS,
  );

  it(
    'shows the middle of a walk, with errors of both coarser meshes',
    async () => {
      const { settled, meshes, shown } = stand({ startS: 3 });
      const { panes } = await settled(isReady);
      const sources = comparedPanes(DEFAULT_LINK).map((id) => panes[id].source);
      expect(sources).toEqual(Array(3).fill('recorded'));
      expect(shown.fine?.length).toBe(3 * 10920);
      const state = await settled(isMeasured);
      expect(state.problem).toBeNull();
      expect(state.timeS).toBeCloseTo(3, 9);
      const { coarse, planned, fine } = state.panes;
      expect([coarse.nVertices, fine.nVertices]).toEqual([714, 10920]);
      expect(planned.nVertices).toBe(state.plan?.vertices);
      expect(meshes.planned?.hanging.length).toBeGreaterThan(50);
      // Faces lose less than folds by chance, and on the planned mesh less than on the coarse one.
      expect(planned.lostM).toBeGreaterThan(0.0005);
      expect(planned.lostM).toBeLessThan(coarse.lostM ?? 0);
      for (const { distanceM, lostM } of [coarse, planned])
        expect(lostM ?? 1).toBeLessThan(distanceM ?? 0);
      for (const { surfaceM, lostM } of [coarse, planned])
        expect(lostM ?? 1).toBeLessThan(surfaceM ?? 0);
      // All frames of the records count, whichever is shown.
      for (const { foldsM } of [coarse, planned]) expect(foldsM).toBeGreaterThan(0.0001);
      expect(state.floor?.foldsM).toBeGreaterThan(0);
      expect(state.floor?.surfaceM).toBeGreaterThan(0);
      for (const { faults } of [coarse, planned, fine]) {
        expect(faults?.n_inside).toBe(0);
        expect(faults?.n_crossings).toBeGreaterThanOrEqual(0);
      }
    },
    PATIENCE_MS,
  );

  it(
    'holds the plan against an even mesh of as many vertices, at the same time',
    async () => {
      const { store, settled, shown } = stand({ startS: 4 });
      await settled(isMeasured);
      store.set({ rival: 'even' });
      const state = await settled((now) => now.rival === 'even' && isMeasured(now));
      expect(state.timeS).toBeCloseTo(4, 9);
      const { even, planned } = state.panes;
      expect(even.source).toBe('recorded');
      expect(Math.abs(even.nVertices / planned.nVertices - 1)).toBeLessThan(0.03);
      expect(shown.even?.length).toBe(3 * even.nVertices);
      expect(planned.lostM).toBeLessThan(even.lostM ?? 0);
      expect(even.foldsM).toBeGreaterThan(0);
    },
    PATIENCE_MS,
  );

  it(
    'plays records in step and ends with them',
    async () => {
      const { store, trio, settled } = stand({ startS: 4.9 });
      await settled(isReady);
      trio.play();
      const state = await settled(({ playing }) => !playing);
      expect(state.timeS).toBeCloseTo(state.endS, 9);
      expect(state.fit?.fires).toBe(false);
      expect(state.fit?.n_frames).toBeGreaterThan(1);
      trio.reset();
      await settled(({ timeS, fit }) => timeS === 0 && fit !== null);
      expect(store.get().phase).toBe('ready');
    },
    PATIENCE_MS,
  );

  it(
    'shows the fine shape on a new plan at once, and computes it from the start',
    async () => {
      const { store, trio, settled, shown, questions } = stand({ startS: 3 });
      await settled(isReady);
      const before = questions.length;
      store.set({ rule: 'demand', demand: 3 });
      const state = await settled(
        ({ phase, plan, panes }) =>
          phase === 'ready' && plan?.largest_loss_m === 0.003 && panes.planned.lostM !== null,
      );
      expect(state.panes.planned.source).toBe('sampled');
      // A mesh's losses are known before it moves, its folds are not.
      expect(state.panes.planned.lostM).toBeGreaterThan(0);
      expect(state.panes.planned.foldsM).toBeNull();
      expect(state.timeS).toBeCloseTo(3, 9);
      // Vertices of the base mesh are vertices of all.
      expect(shown.planned?.slice(0, 9)).toEqual(shown.fine?.slice(0, 9));
      const loads = questions.slice(before).filter(({ type }) => type === 'load');
      expect(loads.length).toBe(1);
      trio.step();
      await settled(({ timeS }) => timeS === 0);
      trio.step();
      const moved = await settled(({ timeS }) => timeS > 0);
      expect(moved.panes.planned.source).toBe('computed');
      expect(moved.panes.planned.surfaceM).toBeLessThan(0.02);
      expect(moved.timeS).toBeCloseTo(1 / 30, 9);
    },
    PATIENCE_MS,
  );

  it(
    'computes what no record has, and leaves fine out when asked to',
    async () => {
      const { trio, settled, shown, questions } = stand({ motion: 'squat', computeFine: false });
      const state = await settled(isReady);
      expect(state.timeS).toBe(0);
      expect(state.panes.fine.source).toBe('resting');
      const begin = shown.coarse?.slice();
      trio.step();
      const moved = await settled(({ timeS }) => timeS > 0);
      expect(shown.coarse).not.toEqual(begin);
      expect(moved.panes.coarse.lostM).toBeNull();
      expect(moved.panes.coarse.msPerFrame).toBeGreaterThan(0);
      const steps = questions.filter(
        (asked) => asked.type === 'advance' && asked.how === 'stepped',
      );
      expect(steps.length).toBe(2);
    },
    PATIENCE_MS,
  );

  it(
    'computes a recorded motion anew with another method, all panes alike',
    async () => {
      const { store, trio, settled } = stand({ computeFine: false });
      await settled(isReady);
      store.set({ method: 'multigrid' });
      const state = await settled((now) => isReady(now) && now.panes.coarse.source === 'computed');
      expect(state.panes.planned.source).toBe('computed');
      trio.step();
      const moved = await settled(({ timeS }) => timeS > 0);
      expect(moved.panes.coarse.msPerFrame).toBeGreaterThan(0);
      expect(moved.problem).toBeNull();
    },
    PATIENCE_MS,
  );

  it(
    'says in a pane what its steps show that no cloth does, until it starts anew',
    async () => {
      const questions: ToGarment[] = [];
      const link = { motion: 'squat' as const, computeFine: false };
      const { store, trio, settled } = stand(link, { start: () => heavy(questions) });
      await settled(isReady);
      trio.step();
      const { panes } = await settled((state) => state.panes.coarse.warnings.length > 0);
      expect(warningWords(panes.coarse)).toMatch(
        /(exploded|stretches too much|stops before).*from 0\.01\d+ s/i,
      );
      expect(warningWords(panes.fine)).toBe('');
      trio.reset();
      await settled((state) => state.timeS === 0 && warningWords(state.panes.coarse) === '');
      // The skirt's two substeps, several times.
      const substeps = hintedSubsteps(panes.coarse);
      expect(substeps).toBeGreaterThanOrEqual(8);
      const before = questions.length;
      store.set({ substeps });
      await settled(isReady);
      const loads = questions.slice(before).filter((asked) => asked.type === 'load');
      expect(loads.map(({ sceneText }) => JSON.parse(sceneText).method.substeps)).toEqual(
        Array.from({ length: 3 }, () => substeps),
      );
    },
    PATIENCE_MS,
  );

  it(
    'computes what cannot be fetched, and says so',
    async () => {
      const fetchBytes = async (url: string) => {
        if (/(coarse|planned)\.recording/.test(url)) throw new Error('offline');
        return recordBytes(url);
      };
      const { settled } = stand({}, { fetchBytes });
      const state = await settled(isReady);
      expect(state.problem?.what).toBe(
        'The recorded frames of coarse and multi-resolution could not be fetched: offline. They are computed here instead, from the beginning and slower than real time.',
      );
      expect(state.panes.planned.source).toBe('sampled');
      expect(state.panes.fine.source).toBe('recorded');
    },
    PATIENCE_MS,
  );

  it(
    'shows the fine cloth on every mesh for as long as that is wanted',
    async () => {
      const { store, settled, shown } = stand({ startS: 3 });
      const own = await settled(isMeasured);
      const { lostM } = own.panes.planned;
      const ownPlaces = shown.planned;
      // Vertices of the base mesh are vertices of all; its last are at the hem.
      const hemOf = (places?: Float32Array) => places?.slice(3 * 700, 3 * 714);
      expect(hemOf(ownPlaces)).not.toEqual(hemOf(shown.fine));
      store.set({ fineCloth: true });
      const ofFine = await settled(({ panes }) => panes.planned.foldsM === null);
      expect(hemOf(shown.planned)).toEqual(hemOf(shown.fine));
      expect(ofFine.panes.planned).toMatchObject({ source: 'recorded', lostM });
      store.set({ fineCloth: false });
      await settled(({ panes }) => panes.planned.foldsM !== null);
      expect(shown.planned).toEqual(ownPlaces);
    },
    PATIENCE_MS,
  );

  it(
    'gives a plan up when told to, and keeps the one it has',
    async () => {
      const planner = plannerParts();
      let isSlow = false;
      const slow = {
        cancel: () => planner.cancel(),
        plan: (wish: Wish) =>
          isSlow ? new Promise<PlanFile>(() => undefined) : planner.plan(wish),
      };
      const { store, trio, settled } = stand({}, { planner: slow });
      await settled(isReady);
      isSlow = true;
      store.set({ rule: 'budget', budget: 4000 });
      expect(store.get()).toMatchObject({ phase: 'loading', doing: { canCancel: true } });
      trio.cancel();
      expect(store.get()).toMatchObject({
        phase: 'ready',
        doing: null,
        rule: 'demand',
        demand: DEFAULT_LINK.demand,
      });
    },
    PATIENCE_MS,
  );

  it(
    'tells of a plan that cannot be made, and goes on with the one it has',
    async () => {
      const { store, settled } = stand();
      await settled(isReady);
      store.set({ rule: 'budget', budget: 10 });
      const state = await settled(({ problem }) => problem !== null);
      expect(state.phase).toBe('ready');
      expect(state.problem?.what).toContain('at least the base mesh');
    },
    PATIENCE_MS,
  );

  it(
    'opens on the first picture, and shows any other time at once',
    async () => {
      const { trio, settled, shown } = stand();
      const first = await settled(isMeasured);
      expect(first).toMatchObject({ problem: null, playing: false });
      expect(first.timeS).toBeCloseTo(FIRST_PICTURE.startS, 9);
      const later = stand({ startS: 2 });
      await later.settled(isMeasured);
      trio.seek(4.9);
      trio.seek(1);
      trio.seek(2); // the last of them counts
      const { panes, fit } = await settled((now) => now.timeS > 1.9 && now.timeS < 2.1);
      expect(panes.planned.source).toBe('recorded');
      await settled(isMeasured);
      expect(shown).toEqual(later.shown);
      // The light has seen all up to there, whatever way led there.
      expect(fit?.n_frames).toBe(61);
      expect(fit).toEqual(later.store.get().fit);
      trio.seek(1);
      const back = await settled((now) => Math.abs(now.timeS - 1) < 1e-6);
      expect(back.fit?.n_frames).toBe(31);
    },
    PATIENCE_MS,
  );

  it(
    'says where it starts when a link asks for a time that nobody recorded',
    async () => {
      const { settled, trio } = stand({ motion: 'walk', startS: 3, computeFine: false });
      const { problem, startS, timeS } = await settled(isReady);
      expect([startS, timeS]).toEqual([0, 0]);
      expect(problem?.what).toMatch(
        /^No frames .*3\.00 s cannot be shown at once.* from 0\.00 s on/,
      );
      trio.seek(1); // nothing comes of it
      expect((await settled(isReady)).timeS).toBe(0);
      const ended = stand({ startS: 9 });
      const state = await ended.settled(isReady);
      expect(state.startS).toBe(state.endS);
      expect(state.problem?.what).toBe(
        'The frames end at 5.00 s, which is shown in place of 9.00 s.',
      );
    },
    PATIENCE_MS,
  );

  it(
    'notices a worker that ends while nothing is asked, and starts again where it was',
    async () => {
      const workers = mortalWorkers(module);
      const { trio, settled, shown } = stand({ startS: 1 }, { start: workers.start });
      await settled(isMeasured);
      trio.seek(2);
      await settled((now) => now.timeS > 1.9 && isMeasured(now));
      const before = { ...shown };
      workers.endLast('out of memory.');
      const again = await settled((now) => isMeasured(now) && now.problem !== null);
      expect(again.problem?.what).toBe(
        'The computation ended by itself at 2.00 s (out of memory). It was started again.',
      );
      expect(workers.nStarted()).toBe(6);
      expect(shown).toEqual(before);
      trio.step();
      await settled((now) => now.timeS > 2.01);
    },
    PATIENCE_MS,
  );

  it(
    'gives up when workers end again at once, until somebody resets',
    async () => {
      const workers = mortalWorkers(module);
      const { store, trio, settled } = stand({}, { start: workers.start });
      await settled(isMeasured);
      workers.endLast('no room');
      await settled(() => workers.nStarted() === 6);
      workers.endLast('no room');
      const { problem } = await settled(({ phase }) => phase === 'stopped');
      expect(problem?.what).toMatch(/happened twice\. .* reset to try once more/);
      trio.reset();
      expect(store.get().problem).toBeNull();
      await settled(isMeasured);
    },
    PATIENCE_MS,
  );

  it('is broken when its module is', async () => {
    const broken = () => {
      const client = garmentClient(module);
      client.terminate();
      return client;
    };
    const { settled } = stand({}, { start: broken });
    const state = await settled(({ phase }) => phase === 'broken');
    expect(state.problem?.what).toContain('did not start');
  });
});
