// Plays both sides of a case in step.

import type { Collider } from '../../shared/bindings/geometry';
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
import type { FrameMessage } from '../../shared/workers/motion-protocol';
import { caseNamed, SIDES, type Side, STEP_S, sceneTextOf } from '../state/failure-cases';
import { type FailuresState, freshSides, type SideState } from '../state/failures-state';
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

function sideAfter(before: SideState, { report, hasEnded }: FrameMessage, msPerStep: number) {
  if (!report) return before;
  const { numbers, message } = report;
  return {
    warnings: numbers.warnings,
    ended: hasEnded ? { sentence: message, timeS: numbers.time_s } : null,
    stretch: numbers.largest_stretch,
    msPerStep,
  };
}

export class Duel {
  private readonly clock: Clock;
  private readonly sides: Record<Side, SideRun>;
  private readonly latest = new Latest(); // load or reset
  private work: Promise<unknown> = Promise.resolve();
  private isStepping = false;
  private nSteps = 0;
  private msPerStep: number | null = null;

  constructor(
    private readonly store: Store<FailuresState>,
    private readonly view: DuelView,
    private readonly parts: DuelParts = BROWSER,
  ) {
    this.clock = createClock(parts);
    const broken = (reason: string) => this.breakDown(reason);
    const sideRun = () => new SideRun(parts.start({ broken }), fabricsText);
    this.sides = { naive: sideRun(), ours: sideRun() };
    store.subscribe((state, previous) => {
      if (state.caseId !== previous.caseId) this.open();
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

  private open(): void {
    const one = caseNamed(this.store.get().caseId);
    void this.begin((side) => this.sides[side].load(sceneTextOf(one, side)), true);
  }

  private isAtEnd(): boolean {
    return this.nSteps >= Math.round(caseNamed(this.store.get().caseId).endS / STEP_S);
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
    const end = Math.round(caseNamed(this.store.get().caseId).endS / STEP_S);
    const count = Math.min(wish, end - this.nSteps);
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
    const sides = { ...this.store.get().sides };
    const begunMs = this.parts.nowMs();
    const frames = await Promise.all(
      SIDES.map(async (side) => {
        const frame = await this.sides[side].step(count);
        const msPerStep = (this.parts.nowMs() - begunMs) / count;
        if (frame) sides[side] = sideAfter(sides[side], frame, msPerStep);
        return frame;
      }),
    );
    this.msPerStep = (this.parts.nowMs() - begunMs) / count;
    if (!isCurrent()) return; // a run that begins anew has buffers of its own
    frames.forEach((frame, pane) => {
      const side = SIDES[pane];
      if (!frame || !side) return;
      const before = this.view.showFrame(pane, frame.buffer);
      if (before) this.sides[side].giveBack(before);
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
    if (error instanceof BrokenWorker) return; // its listener hears
    this.store.set({ playing: false, problem: failureOf(error) });
  }

  private breakDown(reason: string): void {
    const problem = brokenFailure('The cloth', reason);
    this.store.set({ phase: 'broken', playing: false, problem });
  }
}
