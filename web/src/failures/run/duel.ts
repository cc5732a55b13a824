// Plays both sides of a case in step.

import { inputFailure } from '../../shared/bindings/answers';
import type { Collider, Triple } from '../../shared/bindings/geometry';
import { brokenFailure, failureOf } from '../../shared/bindings/refusals';
import { fabricsText } from '../../shared/fabric/fabric-data';
import {
  affordable,
  type Clock,
  createClock,
  DISPLAY,
  type Display,
} from '../../shared/state/clock';
import { Latest } from '../../shared/state/latest';
import type { Store } from '../../shared/state/store';
import { BrokenWorker } from '../../shared/workers/asked';
import { type StartMotion, startMotionWorker } from '../../shared/workers/motion-client';
import { endedSentence } from '../../shared/workers/restarts';
import { caseNamed, SIDES, type Side, STEP_S, sceneTextOf } from '../state/failure-cases';
import { type FailuresState, freshSides } from '../state/failures-state';
import { sideAfter } from './side-reading';
import { SideRun, type SideStart } from './side-run';

/** The picture of a duel. */
export interface DuelView {
  showMesh(pane: number, mesh: SideStart): void;
  /** The frame's buffer belongs to the picture until the next; returns the one before. */
  showFrame(pane: number, buffer: ArrayBuffer): ArrayBuffer | null;
  setColliders(colliders: Collider[]): void;
  /** Shows all of what begins. */
  frame(colliders: Collider[]): void;
  /** Goes with what stands in a pane. */
  follow(pane: number): void;
}

/** The parts of the browser that a duel needs: tests have their own. */
export interface DuelParts extends Display {
  start: StartMotion;
}

const BROWSER: DuelParts = { ...DISPLAY, start: startMotionWorker };

export class Duel {
  private readonly clock: Clock;
  private readonly sides: Record<Side, SideRun>;
  private readonly latest = new Latest(); // load or reset
  private work: Promise<unknown> = Promise.resolve();
  private isStepping = false;
  private nSteps = 0;
  private msPerStep: number | null = null;
  private held: SideRun | null = null;
  private isPulled = false; // a hand took the cloth since it began

  constructor(
    private readonly store: Store<FailuresState>,
    private readonly view: DuelView,
    private readonly parts: DuelParts = BROWSER,
  ) {
    this.clock = createClock(parts);
    const sideRun = () =>
      new SideRun(parts.start, fabricsText, {
        renewed: (reason) => this.startAgain(reason),
        lost: (reason, hasWorked) => this.breakDown(reason, hasWorked),
      });
    this.sides = { naive: sideRun(), ours: sideRun() };
    store.subscribe((state, previous) => {
      if (state.caseId !== previous.caseId) this.retry();
    });
    this.open();
  }

  play(): void {
    if (this.store.get().phase !== 'ready') return;
    const go = () => {
      this.store.set({ playing: true });
      this.clock.start(() => this.tick());
    };
    if (this.isAtEnd()) void this.reset().then(go);
    else go();
  }

  pause(): void {
    this.store.set({ playing: false });
  }

  step(): void {
    this.pause();
    if (!this.isStepping && !this.isAtEnd()) void this.advance(1);
  }

  reset(): Promise<void> {
    return this.begin((side) => this.sides[side].reset(), false);
  }

  /** Shows the case that is being opened at a time, and not the way there [s]. */
  async showAt(timeS: number): Promise<void> {
    await this.work;
    if (this.store.get().phase !== 'ready' || this.nSteps > 0 || this.isStepping) return;
    await this.advance(Math.round(timeS / STEP_S));
  }

  /** Opens the case, by other workers where there are none. */
  retry(): void {
    if (this.store.get().phase === 'broken') {
      for (const side of SIDES) this.sides[side].replace();
      this.store.set({ problem: null });
    }
    this.open();
  }

  /** A hand takes the cloth of a pane: it moves, for as long as it is let. */
  grab(vertex: number, pane: number): void {
    const side = SIDES[pane];
    if (!side || this.store.get().phase !== 'ready') return;
    this.isPulled = true;
    this.held = this.sides[side];
    this.held.grab(vertex);
    if (!this.store.get().playing) this.play();
  }

  moveGrab(target: Triple): void {
    this.held?.moveGrab(target);
  }

  releaseGrab(): void {
    this.held?.releaseGrab();
    this.held = null;
  }

  private open(): void {
    const one = caseNamed(this.store.get().caseId);
    this.store.set({ speed: one.speed ?? 1 });
    void this.begin((side) => this.sides[side].load(sceneTextOf(one, side)), true);
  }

  /** Steps to the end of the case; one whose cloth was pulled has none. */
  private stepsLeft(): number {
    if (this.isPulled) return Number.POSITIVE_INFINITY;
    return Math.round(caseNamed(this.store.get().caseId).endS / STEP_S) - this.nSteps;
  }

  private isAtEnd(): boolean {
    return this.stepsLeft() <= 0;
  }

  /** One thing after the other: a step under way ends before cloth begins anew. */
  private begin(start: (side: Side) => Promise<SideStart>, isFramed: boolean): Promise<void> {
    const isCurrent = this.latest.start();
    this.store.set({ phase: 'loading', playing: false });
    const begun = this.work.then(async () => {
      if (!isCurrent()) return;
      try {
        const starts = await Promise.all(SIDES.map(start));
        if (isCurrent()) this.showStarts(starts, isFramed);
      } catch (error) {
        this.giveUp(error);
      }
    });
    this.work = begun;
    return begun;
  }

  private showStarts(starts: SideStart[], isFramed: boolean): void {
    starts.forEach((start, pane) => {
      this.view.showMesh(pane, start);
      this.view.showFrame(pane, start.buffer);
    });
    const colliders = starts[0]?.colliders ?? [];
    this.view.setColliders(colliders);
    if (isFramed) this.view.frame(colliders);
    this.follow();
    this.nSteps = 0;
    this.msPerStep = null;
    this.held = null;
    this.isPulled = false;
    this.store.set({ phase: 'ready', timeS: 0, sides: freshSides() });
  }

  private tick(): boolean {
    const { playing, speed } = this.store.get();
    this.clock.tick(speed);
    if (!playing || this.isStepping) return playing;
    const count = this.clock.take(STEP_S, affordable(this.msPerStep));
    if (count > 0) void this.advance(count);
    return true;
  }

  private advance(wish: number): Promise<void> {
    const count = Math.min(wish, this.stepsLeft());
    this.isStepping = true;
    const done = this.stepBoth(count).then(
      () => undefined,
      (error) => this.giveUp(error),
    );
    this.work = done;
    return done.then(() => {
      this.isStepping = false;
      if (this.isAtEnd()) this.pause();
    });
  }

  private async stepBoth(count: number): Promise<void> {
    const isCurrent = this.latest.mark();
    const { caseId, sides: before } = this.store.get();
    const sides = { ...before };
    const begunMs = this.parts.nowMs();
    const frames = await Promise.all(
      SIDES.map(async (side) => {
        const frame = await this.sides[side].step(count);
        const msPerStep = (this.parts.nowMs() - begunMs) / count;
        const measure = this.isPulled ? undefined : caseNamed(caseId).measure;
        if (frame) sides[side] = sideAfter(sides[side], frame, msPerStep, measure);
        return frame;
      }),
    );
    this.msPerStep = (this.parts.nowMs() - begunMs) / count;
    if (!isCurrent()) return; // a run that begins anew has buffers of its own
    frames.forEach((frame, pane) => {
      const side = SIDES[pane];
      if (!frame || !side) return;
      const shown = this.view.showFrame(pane, frame.buffer);
      if (shown) this.sides[side].giveBack(shown);
    });
    const colliders = frames[SIDES.indexOf('ours')]?.colliders;
    if (colliders) this.view.setColliders(colliders);
    this.follow();
    this.nSteps += count;
    this.store.set({ timeS: this.nSteps * STEP_S, sides });
  }

  private follow(): void {
    if (caseNamed(this.store.get().caseId).isFollowed) this.view.follow(SIDES.indexOf('ours'));
  }

  private giveUp(error: unknown): void {
    if (error instanceof BrokenWorker) return; // its side hears
    this.store.set({ playing: false, problem: failureOf(error) });
  }

  /** A worker has a successor: both cloths begin anew. */
  private startAgain(reason: string): void {
    const again = 'It was started again, and both cloths are back at their start.';
    this.store.set({ problem: inputFailure(`${endedSentence(reason)} ${again}`) });
    this.open();
  }

  private breakDown(reason: string, hasWorked: boolean): void {
    const problem = hasWorked
      ? inputFailure(`${endedSentence(reason)} That happened twice.`)
      : brokenFailure('The cloth', reason);
    this.store.set({ phase: 'broken', playing: false, problem });
  }
}
