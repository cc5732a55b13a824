// Plays several cloths in step: a worker for each, one clock for all. A worker that ends has a successor, and
// all cloths begin anew.
import { type Failure, inputFailure } from '../bindings/answers';
import { brokenFailure, failureOf } from '../bindings/refusals';
import { affordable, type Clock, createClock, DISPLAY, type Display } from '../state/clock';
import { Latest } from '../state/latest';
import type { Store } from '../state/store';
import { BrokenWorker } from './asked';
import { type StartMotion, startMotionWorker } from './motion-client';
import type { FrameMessage } from './motion-protocol';
import { endedSentence } from './restarts';
import { SideRun, type SideStart } from './side-run';

/** The part of a view's state that a play in step reads and sets. */
export interface InStepState {
  /** `stopped`: nothing runs until a reset; `broken`: nothing can be computed here. */
  phase: 'loading' | 'ready' | 'stopped' | 'broken';
  playing: boolean;
  speed: number;
  timeS: number;
  problem: Failure | null;
}

/** The picture of what is played, a pane for each cloth. */
export interface InStepView {
  showMesh(pane: number, mesh: SideStart): void;
  /** The frame's buffer belongs to the picture until the next; returns the one before. */
  showFrame(pane: number, buffer: ArrayBuffer): ArrayBuffer | null;
}

/** The cloths that are played in step. */
export interface Piece {
  /** A scene for each cloth, of one length of step. */
  sceneTexts(): readonly string[];
  stepS: number;
  /** Infinite where the play has no end. */
  endS(): number;
  /** Sentences that follow the one that a worker ended: it has a successor, or that ended as well. */
  words: { again: string; twice: string };
  /** The phase once a worker and its successor have ended, and after a refusal. */
  lostPhase: 'stopped' | 'broken';
  /** All cloths are at their start and shown; `isNew`: they are others than before. */
  begun(starts: readonly SideStart[], isNew: boolean): void;
  /** All have made steps, and are shown; null for a cloth whose run had ended. Times of a step [ms]. */
  stepped(frames: readonly (FrameMessage | null)[], msPerStep: readonly number[]): void;
  /** The cloth of a pane has made a step that is not shown; without it nobody reads those. */
  passed?(pane: number, frame: FrameMessage): void;
}

/** The parts of the browser that a play needs: tests have their own. */
export interface InStepParts extends Display {
  start: StartMotion;
}

const BROWSER: InStepParts = { ...DISPLAY, start: startMotionWorker };

export class InStep {
  private readonly clock: Clock;
  private readonly latest = new Latest(); // load or reset
  private readonly sides: readonly SideRun[];
  private areLoaded = false;
  private work: Promise<unknown> = Promise.resolve();
  private isStepping = false;
  private nSteps = 0;
  private msPerStep: number | null = null;

  constructor(
    private readonly store: Store<InStepState>,
    private readonly view: InStepView,
    private readonly piece: Piece,
    private readonly parts: InStepParts = BROWSER,
  ) {
    this.clock = createClock(parts);
    const ended = (reason: string, nInARow: number) => this.breakDown(reason, nInARow);
    this.sides = piece.sceneTexts().map(() => new SideRun(parts.start, ended));
  }

  /** Begins what is to be played now, by other workers where there are none. */
  open(): void {
    void this.load();
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
    if (this.store.get().phase !== 'ready') return;
    if (!this.isStepping && !this.isAtEnd()) void this.advance(1);
  }

  reset(): Promise<void> {
    if (!this.areLoaded) return this.load();
    return this.begin((side) => side.reset(), false);
  }

  /** Shows what is being opened at a time, and not the way there [s]. */
  async showAt(timeS: number): Promise<void> {
    await this.work;
    if (this.store.get().phase !== 'ready' || this.nSteps > 0 || this.isStepping) return;
    await this.advance(Math.round(timeS / this.piece.stepS));
  }

  /** The cloth in a pane. */
  side(pane: number): SideRun | undefined {
    return this.sides[pane];
  }

  private load(): Promise<void> {
    const texts = this.piece.sceneTexts();
    for (const side of this.sides) side.open();
    return this.begin((side, pane) => side.load(texts[pane] ?? ''), true);
  }

  private stepsLeft(): number {
    return Math.round(this.piece.endS() / this.piece.stepS) - this.nSteps;
  }

  private isAtEnd(): boolean {
    return this.stepsLeft() <= 0;
  }

  /** One thing after the other: a step under way ends before cloth begins anew. */
  private begin(
    start: (side: SideRun, pane: number) => Promise<SideStart>,
    isNew: boolean,
  ): Promise<void> {
    const isCurrent = this.latest.start();
    this.store.set({ phase: 'loading', playing: false });
    const begun = this.work.then(async () => {
      if (!isCurrent()) return;
      try {
        const starts = await Promise.all(this.sides.map(start));
        if (isCurrent()) this.showStarts(starts, isNew);
      } catch (error) {
        this.giveUp(error);
      }
    });
    this.work = begun;
    return begun;
  }

  private showStarts(starts: readonly SideStart[], isNew: boolean): void {
    starts.forEach((start, pane) => {
      this.view.showMesh(pane, start);
      this.view.showFrame(pane, start.buffer);
    });
    this.areLoaded = true;
    this.nSteps = 0;
    this.msPerStep = null;
    this.piece.begun(starts, isNew);
    this.store.set({ phase: 'ready', timeS: 0 });
  }

  private tick(): boolean {
    const { playing, speed } = this.store.get();
    this.clock.tick(speed);
    if (!playing || this.isStepping) return playing;
    const count = this.clock.take(this.piece.stepS, affordable(this.msPerStep));
    if (count > 0) void this.advance(count);
    return true;
  }

  private advance(wish: number): Promise<void> {
    const count = Math.min(wish, this.stepsLeft());
    this.isStepping = true;
    const done = this.stepAll(count).then(
      () => undefined,
      (error) => this.giveUp(error),
    );
    this.work = done;
    return done.then(() => {
      this.isStepping = false;
      if (this.isAtEnd()) this.pause();
    });
  }

  /** The frame after so many steps; the piece reads those on the way. */
  private async frameAfter(
    count: number,
    side: SideRun,
    pane: number,
  ): Promise<FrameMessage | null> {
    const { piece } = this;
    if (!piece.passed) return side.step(count);
    const isCurrent = this.latest.mark();
    for (let left = count; left > 1; --left) {
      const frame = await side.step(1);
      if (frame === null || frame.hasEnded || !isCurrent()) return frame;
      piece.passed(pane, frame);
      side.giveBack(frame.buffer);
    }
    return side.step(1);
  }

  private async stepAll(count: number): Promise<void> {
    const isCurrent = this.latest.mark();
    const begunMs = this.parts.nowMs();
    const sinceMs = () => (this.parts.nowMs() - begunMs) / count;
    const msPerStep: number[] = [];
    const frames = await Promise.all(
      this.sides.map(async (side, pane) => {
        const frame = await this.frameAfter(count, side, pane);
        msPerStep[pane] = sinceMs();
        return frame;
      }),
    );
    this.msPerStep = sinceMs();
    if (!isCurrent()) return; // a run that begins anew has buffers of its own
    frames.forEach((frame, pane) => {
      const before = frame && this.view.showFrame(pane, frame.buffer);
      if (before) this.sides[pane]?.giveBack(before);
    });
    for (const side of this.sides) side.noteWork();
    this.nSteps += count;
    this.piece.stepped(frames, msPerStep);
    this.store.set({ timeS: this.nSteps * this.piece.stepS });
  }

  private giveUp(error: unknown): void {
    if (error instanceof BrokenWorker) return; // its side hears
    this.areLoaded = false;
    const { lostPhase: phase } = this.piece;
    this.store.set({ phase, playing: false, problem: failureOf(error) });
  }

  /** A worker is gone: all cloths begin anew with another one at once, unless that happened before. */
  private breakDown(reason: string, nInARow: number): void {
    const { words, lostPhase } = this.piece;
    const sentence = endedSentence(reason);
    this.areLoaded = false;
    this.latest.start();
    if (nInARow === 1) {
      this.store.set({ problem: inputFailure(`${sentence} ${words.again}`) });
      return this.open();
    }
    const lost =
      nInARow === 0
        ? { phase: 'broken' as const, problem: brokenFailure('The cloth', reason) }
        : { phase: lostPhase, problem: inputFailure(`${sentence} ${words.twice}`) };
    this.store.set({ ...lost, playing: false });
  }
}
