// Runs the three panes of a garment in step: turns changes of the state into questions to their workers,
// and the answers into state and frames.
import {
  brokenSentence,
  describe,
  type Failure,
  inputFailure,
  internalFailure,
  quoted,
} from '../../shared/bindings/answers';
import { frameViews } from '../../shared/bindings/frame';
import type { Store } from '../../shared/state/store';
import type { SolidsAnswer } from '../bindings/refinement-module';
import { FINE_LEVEL, FRAME_S } from '../state/garment-frames';
import { type MotionId, sceneText, usualFabric } from '../state/garments';
import type { PlanFile } from '../state/plan-file';
import {
  type Doing,
  EMPTY_PANE,
  type GarmentPane,
  PANES,
  type PaneId,
  type RefinementState,
} from '../state/refinement-state';
import type { Described, GarmentMesh, GarmentScalar } from '../worker/garment-protocol';
import { BrokenWorker, type GarmentClient, Refused, startGarmentWorker } from './garment-client';
import { createPaneRun, type PaneRun } from './garment-pane';
import { createPlanner, type Fetched, fetched, isUsual, type Planner } from './planner';
import { recordUrl } from './records';

/** Errors and numbers are read this often while it plays [ms]: faster cannot be read. */
const NUMBERS_EVERY_MS = 500;

/** When the display had to wait, as many frames are left out at most to be at real time again. */
const MOST_LEFT_OUT = 3;

export interface ShownFrame {
  pane: PaneId;
  buffer: ArrayBuffer;
}

export interface TrioView {
  showMesh(pane: PaneId, mesh: GarmentMesh): void;
  /** Of one time. Buffers stay valid until the next call. */
  showFrames(frames: ShownFrame[], solids: SolidsAnswer | null): void;
}

export interface Trio {
  play(): void;
  pause(): void;
  step(): void;
  reset(): void;
  /** Gives up what is on its way, if that can be given up. */
  cancel(): void;
}

/** What it takes to run anywhere. */
export interface TrioParts {
  start(): GarmentClient;
  fetchBytes: Fetched;
  planner: Planner;
  /** Calls back with the next picture. */
  later(callback: () => void): void;
  nowMs(): number;
}

const BROWSER: TrioParts = {
  start: startGarmentWorker,
  fetchBytes: fetched,
  planner: createPlanner(),
  later: (callback) => requestAnimationFrame(callback),
  nowMs: () => performance.now(),
};

function failureOf(error: unknown): Failure {
  if (error instanceof Refused) return error.failure;
  const reason = describe(error);
  if (error instanceof BrokenWorker) return internalFailure(brokenSentence('The garment', reason));
  return inputFailure(`Not all of it could be fetched (${quoted(reason)}). Check the connection.`);
}

function scalarOf({ colour }: RefinementState): GarmentScalar | null {
  return colour === 'curvature' || colour === 'distance' ? colour : null;
}

export function createTrio(
  store: Store<RefinementState>,
  view: TrioView,
  parts: TrioParts = BROWSER,
): Trio {
  const panes = PANES.map((id) => createPaneRun(id, parts.start(), parts.fetchBytes));
  let wanted = 0; // counts loads: what belongs to an earlier one is dropped
  let at = 0; // frame that is shown
  let isPreview = false; // the planned pane shows a sample, and starts anew when it plays
  let isBusy = false;
  let isTakingBack = false; // a wish that was given up
  let isBuilt = false; // all panes are as wanted, but for the plan
  let planned: readonly MotionId[] = []; // further examples of the plan that is there
  let isAskedAgain = false; // for colours, while busy
  let dueFrames = 0;
  let lastTickMs = 0;
  let lastNumbersMs = 0;

  const fine = () => panes.find(({ id }) => id === 'fine') as PaneRun;

  function setPane(id: PaneId, patch: Partial<GarmentPane>): void {
    const known = store.get().panes;
    store.set({ panes: { ...known, [id]: { ...known[id], ...patch } } });
  }

  function refinementOf(id: PaneId, plan: PlanFile): { level: number } | { plan: PlanFile } {
    if (id === 'planned') return { plan };
    return { level: id === 'coarse' ? 0 : FINE_LEVEL };
  }

  function recordOf(id: PaneId): string | null {
    const state = store.get();
    const { garment, motion, fabric, useRecords } = state;
    if (fabric !== usualFabric(garment)) return null;
    // The fine mesh takes longest and is the same whatever is asked of the others.
    if (id !== 'fine' && !useRecords) return null;
    if (id === 'planned' && !isUsual(state)) return null;
    return recordUrl(garment, motion, id);
  }

  async function loadPane(pane: PaneRun, plan: PlanFile, request: number): Promise<void> {
    const { garment, motion, fabric } = store.get();
    const loaded = await pane.load({
      sceneText: sceneText(garment, motion, fabric, refinementOf(pane.id, plan)),
      recordUrl: recordOf(pane.id),
    });
    if (!loaded || request !== wanted) return;
    view.showMesh(pane.id, loaded.mesh);
    const nVertices = loaded.summary.n_vertices;
    const msPerFrame = loaded.recording?.ms_per_frame ?? null;
    const { source } = store.get().panes[pane.id];
    setPane(pane.id, { ...EMPTY_PANE, source, nVertices, msPerFrame });
  }

  function setSources(): void {
    const { computeFine } = store.get();
    for (const pane of panes) {
      const isRest = pane.id === 'fine' && !computeFine;
      pane.source = pane.recording() ? 'recorded' : isRest ? 'resting' : 'computed';
    }
    isPreview = false;
  }

  function endFrame(): number {
    const lengths = panes.map((pane) => pane.recording()?.n_frames ?? Number.POSITIVE_INFINITY);
    return Math.min(...lengths, 1 + Math.round(10 / FRAME_S)) - 1;
  }

  /** Everything that is wanted, then its first picture. */
  async function load(what: 'all' | 'plan'): Promise<void> {
    wanted += 1;
    const request = wanted;
    if (what === 'all') isBuilt = false;
    const words = isBuilt ? 'Planning' : 'Fetching and building three meshes';
    const doing: Doing = { what: words, canCancel: isBuilt, share: null };
    store.set({ phase: 'loading', playing: false, doing });
    try {
      const { further } = store.get();
      const plan = await parts.planner.plan(store.get(), (motion, share) => {
        const running = `Running the ${motion.replaceAll('_', ' ')} on the fine mesh`;
        if (request === wanted) store.set({ doing: { what: running, canCancel: true, share } });
      });
      if (request !== wanted) return;
      store.set({ plan, doing, face: null, fit: null });
      planned = further;
      await Promise.all(panes.map((pane) => loadPane(pane, plan, request)));
      if (request !== wanted) return;
      setSources();
      const nFine = store.get().panes.fine.nVertices;
      const budgetRange: [number, number] = [plan.base_mesh.vertices, nFine];
      store.set({ budgetRange, endS: endFrame() * FRAME_S });
      await idle();
      await start(request);
      if (request !== wanted) return;
      isBuilt = true;
      store.set({ phase: 'ready', doing: null });
    } catch (error) {
      if (request !== wanted) return;
      const isBroken = error instanceof BrokenWorker;
      // A link's examples that cannot be had leave the rest of it.
      if (!isBuilt && !isBroken && store.get().further.length > 0)
        return store.set({ further: [], problem: failureOf(error) });
      if (isBuilt) takeBack({ further: planned });
      const isShown = panes.every((pane) => pane.isLoaded());
      const phase = isBroken ? 'broken' : isShown ? 'ready' : 'stopped';
      store.set({ phase, doing: null, problem: failureOf(error) });
    }
  }

  function takeBack(patch: Partial<RefinementState>): void {
    isTakingBack = true;
    store.set(patch);
    isTakingBack = false;
  }

  /** What runs meanwhile comes to its end. */
  async function idle(): Promise<void> {
    while (isBusy) await new Promise<void>((resolve) => parts.later(resolve));
  }

  /** The first picture: where the link says if frames come with the page, else at the beginning. */
  async function start(request: number): Promise<void> {
    const first = Math.min(Math.round(store.get().startS / FRAME_S), endFrame());
    const isComputed = panes.some(({ source }) => source === 'computed');
    isPreview = isComputed && fine().source === 'recorded';
    await restart(isComputed && !isPreview ? 0 : first, request);
  }

  async function restart(frame: number, request = wanted): Promise<void> {
    store.set({ fit: null });
    await Promise.all(panes.map((pane) => pane.reset()));
    if (request !== wanted) return;
    at = frame;
    await advanceAll((pane) => (pane.source === 'recorded' ? 'recorded' : 'still'));
    await describeAll(true);
  }

  async function advanceAll(
    how: (pane: PaneRun) => 'recorded' | 'stepped' | 'still',
  ): Promise<string | null> {
    const request = wanted;
    let ended: string | null = null;
    await Promise.all(
      panes.map(async (pane) => {
        const answer = await pane.advance(at, how(pane));
        if (answer.fit && request === wanted) store.set({ fit: answer.fit });
        ended ??= answer.ended && `${pane.id}: ${answer.ended}`;
      }),
    );
    return ended;
  }

  function describePane(
    pane: PaneRun,
    reference: Float32Array | null,
    wantsNumbers: boolean,
  ): Promise<Described> {
    const state = store.get();
    const isOther = pane.id !== 'fine';
    const isSampled = isPreview && isOther && pane.source === 'computed';
    const isCompared = wantsNumbers || state.colour === 'distance' || isSampled;
    return pane.describe({
      scalar: scalarOf(state),
      reference: isOther && isCompared ? reference : null,
      fineLevel: FINE_LEVEL,
      takesSample: isSampled,
      timeS: at * FRAME_S,
      wantsAll: wantsNumbers && !state.playing,
    });
  }

  /** The shown time in all panes, with numbers where they are due. */
  async function describeAll(wantsNumbers: boolean): Promise<void> {
    const request = wanted;
    const last = await describePane(fine(), null, wantsNumbers);
    const isInStep = fine().source !== 'resting';
    const reference = isInStep ? frameViews(last.buffer).positions.slice() : null;
    const others = panes.filter((pane) => pane !== fine());
    const answers = await Promise.all(
      others.map((pane) => describePane(pane, reference, wantsNumbers)),
    );
    if (request !== wanted) return;
    const shown = [...others, fine()].map((pane, index) => ({
      pane,
      described: answers[index] ?? last,
    }));
    if (wantsNumbers) for (const { pane, described } of shown) tell(pane, described);
    view.showFrames(
      shown.map(({ pane, described }) => ({ pane: pane.id, buffer: described.buffer })),
      answers[0]?.solids ?? null,
    );
    for (const { pane, described } of shown) pane.keep(described);
    store.set({ timeS: at * FRAME_S });
  }

  /** The numbers of one pane. */
  function tell(pane: PaneRun, { errorM, surfaceM, faults, costs }: Described): void {
    const isSampled = isPreview && pane.source === 'computed';
    const patch: Partial<GarmentPane> = {
      errorM: isSampled ? null : errorM,
      surfaceM: isSampled ? null : surfaceM,
      faults: isSampled ? null : faults,
      source: isSampled ? 'sampled' : pane.source,
    };
    if (pane.source === 'computed' && costs) Object.assign(patch, pane.costs(costs));
    setPane(pane.id, patch);
  }

  /** Goes on by some frames; `isSingle` with all numbers. */
  async function goOn(nFrames: number, isSingle: boolean): Promise<void> {
    const isComputed = panes.some(({ source }) => source === 'computed');
    if (isPreview) {
      isPreview = false;
      return restart(0);
    }
    if (at >= endFrame()) {
      if (!isSingle) pauseAtEnd();
      return;
    }
    at = Math.min(endFrame(), at + (isComputed ? 1 : nFrames));
    const ended = await advanceAll(({ source }) => {
      if (source === 'recorded') return 'recorded';
      return source === 'computed' ? 'stepped' : 'still';
    });
    const nowMs = parts.nowMs();
    const wantsNumbers = isSingle || ended !== null || nowMs - lastNumbersMs >= NUMBERS_EVERY_MS;
    if (wantsNumbers) lastNumbersMs = nowMs;
    await describeAll(wantsNumbers);
    if (ended !== null) {
      const what = `The run stopped at ${(at * FRAME_S).toFixed(2)} s. ${ended}. The last good frame stays; reset to start again.`;
      store.set({ phase: 'stopped', playing: false, problem: inputFailure(what) });
    }
  }

  function pauseAtEnd(): void {
    store.set({ playing: false });
  }

  /** One thing at a time; what fails is told. */
  async function alone(work: () => Promise<void>): Promise<void> {
    if (isBusy) return;
    isBusy = true;
    const request = wanted;
    try {
      await work();
    } catch (error) {
      if (request === wanted) {
        const phase = error instanceof BrokenWorker ? 'broken' : 'stopped';
        store.set({ phase, playing: false, doing: null, problem: failureOf(error) });
      }
    }
    isBusy = false;
    if (!isAskedAgain) return;
    isAskedAgain = false;
    recolour();
  }

  function recolour(): void {
    if (store.get().phase !== 'ready') return;
    if (isBusy) isAskedAgain = true;
    else void alone(() => describeAll(true));
  }

  function tick(): void {
    const { playing, speed, phase } = store.get();
    if (!playing) return;
    const nowMs = parts.nowMs();
    dueFrames += ((nowMs - lastTickMs) / 1000 / FRAME_S) * speed;
    dueFrames = Math.min(dueFrames, MOST_LEFT_OUT);
    lastTickMs = nowMs;
    const count = Math.floor(dueFrames);
    if (count > 0 && !isBusy && phase === 'ready') {
      dueFrames -= count;
      void alone(() => goOn(count, false));
    }
    parts.later(tick);
  }

  store.subscribe((state, previous) => {
    const differs = (...keys: (keyof RefinementState)[]) =>
      keys.some((key) => !Object.is(state[key], previous[key]));
    if (state.phase === 'broken' || isTakingBack) return;
    if (differs('garment', 'motion', 'fabric', 'useRecords', 'computeFine', 'startS'))
      void load('all');
    else if (differs('further', 'rule', 'demand', 'budget')) void load('plan');
    else if (differs('colour')) recolour();
    if (state.playing && !previous.playing) {
      lastTickMs = parts.nowMs();
      dueFrames = 1;
      parts.later(tick);
    }
  });
  void load('all');

  return {
    play() {
      const { phase } = store.get();
      if (phase !== 'ready' && phase !== 'loading') return;
      if (at >= endFrame()) void alone(() => restart(0)).then(() => store.set({ playing: true }));
      else store.set({ playing: true });
    },
    pause() {
      store.set({ playing: false });
      recolour();
    },
    step() {
      store.set({ playing: false });
      if (store.get().phase === 'ready') void alone(() => goOn(1, true));
    },
    reset() {
      if (store.get().phase === 'loading' || store.get().phase === 'broken') return;
      store.set({ playing: false, phase: 'ready', problem: null });
      void idle().then(() => alone(() => restart(0)));
    },
    cancel() {
      const { doing, plan } = store.get();
      if (!doing?.canCancel) return;
      wanted += 1;
      parts.planner.cancel();
      if (!plan || !isBuilt) return store.set({ further: [] }); // the rest is still wanted
      const budget = plan.vertex_budget ?? null;
      const demand = plan.detail_demand ?? store.get().demand;
      const rule = budget === null ? 'demand' : 'budget';
      takeBack({ further: planned, rule, demand, budget, phase: 'ready', doing: null });
    },
  };
}
