// Runs the three panes of a garment in step: turns changes of the state into loads, plans and frames.

import {
  describe,
  type Failure,
  inputFailure,
  quoted,
  Refused,
} from '../../shared/bindings/answers';
import { brokenFailure } from '../../shared/bindings/refusals';
import { fetchedBytes } from '../../shared/page/fetched';
import { type Clock, createClock, DISPLAY, type Display } from '../../shared/state/clock';
import { type IsCurrent, Latest } from '../../shared/state/latest';
import type { Store } from '../../shared/state/store';
import { BrokenWorker } from '../../shared/workers/asked';
import { endedSentence, Restarts } from '../../shared/workers/restarts';
import { FRAME_S } from '../state/garment-frames';
import type { MotionId } from '../state/garments';
import type { PlanFile } from '../state/plan-file';
import {
  canSeek,
  type Doing,
  isComputedHere,
  PANE_TITLES,
  type PaneId,
  type RefinementState,
} from '../state/refinement-state';
import { startGarmentWorker } from './garment-client';
import { type PaneParts, PaneSet, type TrioView } from './pane-set';
import { ExamplePlanner, type Planner } from './planner';

/** The parts of the browser that a trio needs: tests have their own. */
export interface TrioParts extends PaneParts, Display {
  planner: Planner;
}

/** Errors and numbers are read this often while it plays [ms]: faster cannot be read. */
const NUMBERS_EVERY_MS = 500;

/** When the display had to wait, as many frames are left out at most to be at real time again. */
const MOST_LEFT_OUT = 3;

const BROWSER: TrioParts = {
  ...DISPLAY,
  start: startGarmentWorker,
  fetchBytes: fetchedBytes,
  planner: new ExamplePlanner(),
};

function failureOf(error: unknown): Failure {
  if (error instanceof Refused) return error.failure;
  const reason = quoted(describe(error));
  return inputFailure(`Not all of it could be fetched (${reason}). Check the connection.`);
}

/** Says what is computed for want of the frames that come with the page. */
function missedFailure({ panes, reason }: { panes: readonly PaneId[]; reason: string }): Failure {
  const names = new Intl.ListFormat('en-GB').format(
    panes.map((id) => PANE_TITLES[id].toLowerCase()),
  );
  return inputFailure(
    `The recorded frames of ${names} could not be fetched: ${quoted(reason)}. They are computed here instead, from the beginning and slower than real time.`,
  );
}

/** Says what is shown in place of a time that was asked for; null where it is that time. */
function elsewhereFailure(askedS: number, shownS: number, isComputed: boolean): Failure | null {
  if (Math.abs(askedS - shownS) <= FRAME_S / 2) return null;
  const [asked, shown] = [askedS, shownS].map((timeS) => `${timeS.toFixed(2)} s`);
  return inputFailure(
    isComputed
      ? `No frames of this motion come with the page, so that ${asked} cannot be shown at once: it is computed here, from ${shown} on. Press Play.`
      : `The frames end at ${shown}, which is shown in place of ${asked}.`,
  );
}

export class Trio {
  private readonly panes: PaneSet;
  private readonly clock: Clock;
  private readonly latest = new Latest(); // load
  private readonly restarts = new Restarts();
  private isBusy = false;
  private soughtS: number | null = null; // the last time that was asked for and is not shown yet
  private isAskedAgain = false; // colours and cloth were wanted while busy
  private isTakingBack = false; // a wish that was given up
  private isBuilt = false; // all panes are as wanted, but for the plan
  private planned: readonly MotionId[] = []; // further examples of the plan that is there

  constructor(
    private readonly store: Store<RefinementState>,
    view: TrioView,
    private readonly parts: TrioParts = BROWSER,
  ) {
    this.panes = new PaneSet(store, view, parts, (reason) => this.breakDown(reason));
    this.clock = createClock(parts);
    store.subscribe((state, previous) => this.follow(state, previous));
    void this.load('all');
  }

  play(): void {
    const { phase } = this.store.get();
    if (phase !== 'ready' && phase !== 'loading') return;
    const play = () => this.store.set({ playing: true });
    if (this.panes.isAtEnd()) void this.restart().then(play);
    else play();
  }

  pause(): void {
    this.store.set({ playing: false });
    this.recolour();
  }

  step(): void {
    this.store.set({ playing: false });
    if (this.store.get().phase !== 'ready') return;
    void this.idle().then(() => this.alone((isCurrent) => this.goOn(1, isCurrent)));
  }

  reset(): void {
    const { phase } = this.store.get();
    if (phase === 'loading' || phase === 'broken') return;
    this.store.set({ playing: false, problem: null });
    if (!this.panes.isLoaded()) return void this.load('all');
    this.store.set({ phase: 'ready' });
    void this.idle().then(() => this.restart());
  }

  /** Shows another time, if that can be had at once; of several in a row the last one. */
  seek(timeS: number): void {
    if (!canSeek(this.store.get())) return;
    this.store.set({ playing: false });
    const isUnderWay = this.soughtS !== null;
    this.soughtS = timeS;
    if (!isUnderWay) void this.seekOn();
  }

  private async seekOn(): Promise<void> {
    let shownS: number | null = null;
    while (this.soughtS !== shownS) {
      await this.idle();
      if (!canSeek(this.store.get())) break; // something else is loaded meanwhile
      const timeS: number = this.soughtS ?? 0;
      if (await this.alone((isCurrent) => this.panes.seek(timeS, isCurrent))) shownS = timeS;
    }
    this.soughtS = null;
    this.recolour();
  }

  /** Gives up what is on its way, if that can be given up. */
  cancel(): void {
    const { doing, plan } = this.store.get();
    if (!doing?.canCancel) return;
    this.latest.start();
    this.parts.planner.cancel();
    if (!plan || !this.isBuilt) return this.store.set({ further: [] }); // the rest is still wanted
    const budget = plan.vertex_budget ?? null;
    const lostM = plan.largest_loss_m;
    const demand = lostM === undefined ? this.store.get().demand : 1000 * lostM;
    const rule = budget === null ? 'demand' : 'budget';
    const { planned: further } = this;
    this.takeBack({ further, rule, demand, budget, phase: 'ready', doing: null });
  }

  private follow(state: RefinementState, previous: RefinementState): void {
    const differs = (...keys: (keyof RefinementState)[]) =>
      keys.some((key) => !Object.is(state[key], previous[key]));
    if (state.phase === 'broken' || this.isTakingBack) return;
    const ofPanes = ['garment', 'motion', 'fabric', 'rival', 'method', 'substeps'] as const;
    if (differs(...ofPanes, 'useRecords', 'computeFine', 'startS')) void this.load('all');
    else if (differs('further', 'rule', 'demand', 'budget')) void this.load('plan');
    else if (differs('colour', 'fineCloth')) this.recolour();
    if (!state.playing || previous.playing) return;
    this.clock.start(() => this.tick());
    this.clock.advance(FRAME_S); // the first one at once
  }

  /** Loads everything that is wanted, then shows its first picture. */
  private async load(what: 'all' | 'plan'): Promise<void> {
    const isCurrent = this.latest.start();
    if (what === 'all') this.isBuilt = false;
    const words = this.isBuilt ? 'Planning' : 'Fetching and building three meshes';
    const doing: Doing = { what: words, canCancel: this.isBuilt, share: null };
    this.store.set({ phase: 'loading', playing: false, doing });
    try {
      await this.bring(doing, isCurrent);
      if (!isCurrent()) return;
      this.isBuilt = true;
      this.store.set({ phase: 'ready', doing: null });
      this.recolour(); // comes with the numbers, which take longer than the picture
    } catch (error) {
      if (isCurrent()) this.giveUp(error);
    }
  }

  /** Makes the plan, has the panes load what it says, and shows the first picture. */
  private async bring(doing: Doing, isCurrent: IsCurrent): Promise<void> {
    const { further } = this.store.get();
    const plan = await this.plan(isCurrent);
    if (!isCurrent()) return;
    this.store.set({ plan, doing, face: null, fit: null });
    this.planned = further;
    await this.panes.load(plan, isCurrent);
    if (!isCurrent()) return;
    const missed = this.panes.missed();
    if (missed) this.store.set({ problem: missedFailure(missed) });
    const nFine = this.store.get().panes.fine.nVertices;
    const budgetRange: [number, number] = [plan.base_mesh.vertices, nFine];
    this.store.set({ budgetRange, endS: this.panes.endFrame() * FRAME_S });
    await this.idle();
    await this.panes.start(isCurrent);
    if (isCurrent()) this.sayElsewhere();
  }

  /** The link starts where the picture does. */
  private sayElsewhere(): void {
    const state = this.store.get();
    const { startS, timeS, problem } = state;
    const elsewhere = elsewhereFailure(startS, timeS, isComputedHere(state));
    if (elsewhere) this.takeBack({ startS: timeS, problem: problem ?? elsewhere });
  }

  private plan(isCurrent: IsCurrent): Promise<PlanFile> {
    return this.parts.planner.plan(this.store.get(), (motion, share) => {
      const what = `Running the ${motion.replaceAll('_', ' ')} on the fine mesh`;
      if (isCurrent()) this.store.set({ doing: { what, canCancel: true, share } });
    });
  }

  /** Says what could not be loaded, and shows what is left. */
  private giveUp(error: unknown): void {
    if (error instanceof BrokenWorker) return this.breakDown(error.message);
    const problem = failureOf(error);
    // When a link's further examples cannot be had, the rest of it is shown.
    if (!this.isBuilt && this.store.get().further.length > 0)
      return this.store.set({ further: [], problem });
    if (this.isBuilt) this.takeBack({ further: this.planned });
    const phase = this.panes.isLoaded() ? 'ready' : 'stopped';
    this.store.set({ phase, doing: null, problem });
  }

  /** A worker has ended: others take the places of all, once. */
  private breakDown(reason: string): void {
    const hasStarted = this.panes.hasStarted() || this.isBuilt;
    if (hasStarted) this.restarts.noteStart();
    const mayStart = this.restarts.noteEnd() <= 1;
    const state = this.store.get();
    const { timeS, startS } = state;
    const isComputed = isComputedHere(state);
    this.latest.start(); // answers under way are of the workers that are ended
    this.panes.renew();
    this.parts.planner.cancel();
    this.isBuilt = false;
    const rest = { playing: false, doing: null } as const;
    if (!hasStarted && mayStart) {
      const problem = brokenFailure('The garment', reason);
      return this.store.set({ ...rest, phase: 'broken', problem });
    }
    const ended = endedSentence(reason, timeS > 0 ? ` at ${timeS.toFixed(2)} s` : '');
    if (!mayStart) {
      const what = `${ended} That happened twice. Choose another garment or motion, or reset to try once more.`;
      return this.store.set({ ...rest, phase: 'stopped', problem: inputFailure(what) });
    }
    const where = isComputed && timeS > 0 ? ', and what is computed here is back at its start' : '';
    const problem = inputFailure(`${ended} It was started again${where}.`);
    this.takeBack({ ...rest, startS: isComputed ? startS : timeS, problem });
    void this.load('all');
  }

  private takeBack(patch: Partial<RefinementState>): void {
    this.isTakingBack = true;
    this.store.set(patch);
    this.isTakingBack = false;
  }

  /** Waits until the work under way has ended. */
  private async idle(): Promise<void> {
    while (this.isBusy) await new Promise<void>((resolve) => this.parts.later(resolve));
  }

  private restart(): Promise<boolean> {
    return this.alone((isCurrent) => this.panes.restart(0, isCurrent));
  }

  /** Goes on by some frames; while it does not play, with all numbers. */
  private async goOn(nFrames: number, isCurrent: IsCurrent): Promise<void> {
    if (await this.panes.leavePreview(isCurrent)) return;
    const isSingle = !this.store.get().playing;
    if (this.panes.isAtEnd()) return this.store.set({ playing: false });
    const ended = await this.panes.goOn(nFrames, isCurrent);
    const areDue = this.clock.areNumbersDue(NUMBERS_EVERY_MS, isSingle || ended !== null);
    await this.panes.describe(areDue, isCurrent);
    if (ended === null || !isCurrent()) return;
    const what = `The run stopped at ${this.panes.timeS().toFixed(2)} s. ${ended}. The last good frame stays; reset to start again.`;
    this.store.set({ phase: 'stopped', playing: false, problem: inputFailure(what) });
  }

  /** One thing at a time, false while there is another; what fails is told. */
  private async alone(work: (isCurrent: IsCurrent) => Promise<void>): Promise<boolean> {
    if (this.isBusy) return false;
    this.isBusy = true;
    const isCurrent = this.latest.mark();
    try {
      await work(isCurrent);
      if (isCurrent()) this.restarts.noteWork();
    } catch (error) {
      if (isCurrent()) this.stop(error);
    }
    this.isBusy = false;
    const isAskedAgain = this.isAskedAgain;
    this.isAskedAgain = false;
    if (isAskedAgain) this.recolour();
    return true;
  }

  private stop(error: unknown): void {
    if (error instanceof BrokenWorker) return this.breakDown(error.message);
    const problem = failureOf(error);
    this.store.set({ phase: 'stopped', playing: false, doing: null, problem });
  }

  private recolour(): void {
    if (this.store.get().phase !== 'ready') return;
    if (this.isBusy) this.isAskedAgain = true;
    else void this.alone((isCurrent) => this.panes.describe(true, isCurrent));
  }

  private tick(): boolean {
    const { playing, speed, phase } = this.store.get();
    this.clock.tick(speed);
    if (!playing || this.isBusy || phase !== 'ready') return playing;
    const count = this.clock.take(FRAME_S, MOST_LEFT_OUT);
    if (count > 0) void this.alone((isCurrent) => this.goOn(count, isCurrent));
    return true;
  }
}
