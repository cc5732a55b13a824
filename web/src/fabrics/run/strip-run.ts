// Lets a strip of each fabric down over an edge until it rests: one after the other, in one worker.
import { type Failure, inputFailure } from '../../shared/bindings/answers';
import { frameViews } from '../../shared/bindings/frame';
import { brokenFailure, failureOf } from '../../shared/bindings/refusals';
import { createClock } from '../../shared/state/clock';
import type { Store } from '../../shared/state/store';
import { BrokenWorker } from '../../shared/workers/asked';
import { type StartMotion, startMotionWorker } from '../../shared/workers/motion-client';
import { endedSentence } from '../../shared/workers/restarts';
import { SideRun, type SideStart } from '../../shared/workers/side-run';
import { droopOf, namesByBendingLength, stripTextOf, tipOf } from '../state/strips';
import type { StripsState } from '../state/strips-state';

/** Steps after which a strip is looked at: a quarter of a second. */
const STEPS_AT_ONCE = 15;

/** A strip on its way is drawn at most this often: the time is for the others [ms]. */
const PICTURE_EVERY_MS = 200;

/** A strip rests whose end moves by less in that time, twice in a row [m]. */
const REST_M = 2e-6;

/** No strip is let down for longer [steps]. */
const MOST_STEPS = 3600;

export interface StripView {
  /** The strip of that fabric, at its start. */
  showStrip(fabric: string, start: SideStart): void;
  /** The buffer belongs to the picture until the next one of that fabric. */
  showFrame(fabric: string, buffer: ArrayBuffer): void;
}

export class StripRun {
  private readonly side: SideRun;
  private readonly clock = createClock();
  private nGone = 0; // how often work was given up

  constructor(
    private readonly store: Store<StripsState>,
    private readonly view: StripView,
    start: StartMotion = startMotionWorker,
  ) {
    this.side = new SideRun(start, (reason, nInARow) => this.breakDown(reason, nInARow));
  }

  /** Lets those down that have not come to rest yet. */
  go(): void {
    if (this.store.get().phase !== 'stopped') return;
    this.store.set({ phase: 'running' });
    void this.letAllDown();
  }

  /** Gives up the strip that is on its way; those at rest stay. */
  stop(): void {
    if (this.store.get().phase !== 'running') return;
    this.end();
    this.store.set({ phase: 'stopped' });
  }

  private end(): void {
    this.nGone += 1;
    this.side.close();
  }

  private async letAllDown(): Promise<void> {
    const { nGone } = this;
    try {
      for (const fabric of namesByBendingLength()) {
        if (this.store.get().droops[fabric] !== undefined) continue;
        const droop = await this.letDown(fabric);
        if (nGone !== this.nGone) return;
        this.side.noteWork();
        this.store.set({ droops: { ...this.store.get().droops, [fabric]: droop } });
      }
      this.end(); // its memory is of no use any more
      this.store.set({ phase: 'done' });
    } catch (error) {
      if (nGone !== this.nGone || error instanceof BrokenWorker) return;
      this.giveUp(failureOf(error));
    }
  }

  /** Degrees by which the strip droops at rest. */
  private async letDown(fabric: string): Promise<number> {
    const { nGone, side } = this;
    const started = await side.load(stripTextOf(fabric));
    if (nGone !== this.nGone) return Number.NaN;
    this.view.showStrip(fabric, started);
    let shown = started.buffer;
    let tip = tipOf(frameViews(shown).positions);
    let nStill = 0;
    for (let step = 0; nStill < 2; step += STEPS_AT_ONCE) {
      if (step >= MOST_STEPS) throw new Error(`the strip of ${fabric} comes to no rest`);
      const frame = await side.step(STEPS_AT_ONCE);
      if (nGone !== this.nGone) return Number.NaN;
      if (!frame) throw new Error(`the strip of ${fabric} ended before it came to rest`);
      const before = tip;
      tip = tipOf(frameViews(frame.buffer).positions);
      const move = Math.hypot(...tip.map((metres, axis) => metres - (before[axis] ?? 0)));
      nStill = move < REST_M ? nStill + 1 : 0;
      const isDrawn = this.clock.areNumbersDue(PICTURE_EVERY_MS, nStill === 2);
      if (isDrawn) this.view.showFrame(fabric, frame.buffer);
      side.giveBack(isDrawn ? shown : frame.buffer);
      if (isDrawn) shown = frame.buffer;
    }
    return droopOf(frameViews(shown).positions);
  }

  private giveUp(problem: Failure): void {
    this.end();
    this.store.set({ phase: 'stopped', problem });
  }

  /** The worker is gone: another one goes on with the strips that are left, once. */
  private breakDown(reason: string, nInARow: number): void {
    this.end();
    if (nInARow === 0)
      return this.store.set({ phase: 'broken', problem: brokenFailure('The strips', reason) });
    const after =
      nInARow === 1
        ? 'It was started again, with the strips that are left.'
        : 'That happened twice: go on to try once more.';
    const problem = inputFailure(`${endedSentence(reason)} ${after}`);
    this.store.set({ phase: 'stopped', problem });
    if (nInARow === 1) this.go();
  }
}
