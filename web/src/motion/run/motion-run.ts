// Runs the shown cloth: turns changes of the state into questions to its worker, and answers into state and frames.
import { brokenSentence, type Failure, sentenceOf } from '../../shared/bindings/answers';
import type { Scalar } from '../../shared/bindings/frame';
import type { Triple } from '../../shared/bindings/geometry';
import { fabricsText } from '../../shared/fabric/fabric-data';
import type { Store } from '../../shared/state/store';
import { answerOf } from '../../shared/workers/asked';
import { type MotionState, shownHeat } from '../state/motion-state';
import type {
  FrameMessage,
  FromMotion,
  LoadedMessage,
  RunReport,
  ToMotion,
} from '../worker/motion-protocol';
import {
  type MotionClient,
  type StartMotion,
  type StartObj,
  startMotionWorker,
  startObjWorker,
} from './motion-client';
import { ObjSource } from './obj-source';
import { referenceUrl } from './references';
import { RunClock } from './run-clock';
import { type Content, canKeepMotion, isSameScene, loadOf } from './run-content';
import { RunFrames } from './run-frames';
import { endOf } from './run-words';
import { createStepTimer } from './step-timing';

/** Running ahead of the first picture gives up after this much of the clock [ms]. */
const LONGEST_AHEAD_MS = 4000;

/** Time of a step that is expected before one was measured [ms]. */
const EXPECTED_STEP_MS = 10;

export interface MotionRunView {
  /** A new mesh; its first frame follows at once. */
  showMesh(triangles: Uint32Array, nVertices: number, isNewScene: boolean): void;
  /** The buffer stays valid until the next call. */
  showFrame(buffer: ArrayBuffer, scalar: Scalar): void;
}

type Reload = Extract<ToMotion, { type: 'load' | 'reset' }>;

/** Opens the worker, loads the state's setting, and follows the store from then on. */
export class MotionRun {
  private readonly client: MotionClient;
  readonly obj: ObjSource;
  private readonly clock = new RunClock();
  private readonly frames = new RunFrames();
  private readonly timer = createStepTimer();
  private request = 0; // counts loads and resets: what belongs to an earlier one is dropped
  private isWaiting = false; // for the answer to a load or a reset
  private isStepping = false;
  private loaded: Content | null = null;
  private referenceAt: string | null = null; // that the worker has, or is about to get
  private aheadSinceMs: number | null = null; // running to the start time, nothing is shown
  private tickHandle = 0;

  constructor(
    private readonly store: Store<MotionState>,
    private readonly view: MotionRunView,
    start: StartMotion = startMotionWorker,
    startObj: StartObj = startObjWorker,
  ) {
    this.client = start({
      news: (message) => this.hear(message),
      broken: (reason) => this.breakDown(reason),
    });
    this.obj = new ObjSource(store, startObj, () => void this.load());
    store.subscribe((state, previous) => {
      if (state.setting !== previous.setting && state.phase !== 'broken') void this.load();
      if (state.playing && !previous.playing) this.startClock();
      if (shownHeat(state) !== shownHeat(previous)) this.refill();
    });
    void this.open();
  }

  play(): void {
    const { phase } = this.store.get();
    if (phase === 'ready' || phase === 'loading') this.store.set({ playing: true, invited: false });
  }

  pause(): void {
    this.store.set({ playing: false, pace: null });
  }

  step(): void {
    this.store.set({ playing: false, invited: false, pace: null });
    const isFree = !this.isWaiting && !this.isStepping;
    if (this.store.get().phase === 'ready' && isFree) void this.send(1);
  }

  reset(): void {
    const { phase, setting } = this.store.get();
    if (phase === 'broken' || !this.loaded) return;
    this.aheadSinceMs = null;
    this.store.set({ playing: false, held: false, phase: 'loading', startS: 0, ahead: null });
    if (this.loaded.setting !== setting) return void this.load();
    this.request += 1;
    void this.reload({ type: 'reset', request: this.request, scalar: this.scalar() }, this.loaded);
  }

  grab(vertex: number): void {
    this.client.tell({ type: 'grab', vertex });
    this.store.set({ held: true });
  }

  moveGrab(target: Triple): void {
    this.client.tell({ type: 'moveGrab', target });
  }

  releaseGrab(): void {
    this.client.tell({ type: 'releaseGrab' });
    this.store.set({ held: false });
  }

  private async open(): Promise<void> {
    if (await this.answer(this.client.ask({ type: 'open', fabricsText }))) await this.load();
  }

  private breakDown(reason: string): void {
    const sentence = brokenSentence('The cloth', reason);
    this.store.set({ phase: 'broken', playing: false, problem: { source: 'browser', sentence } });
  }

  private hear(message: FromMotion): void {
    if (message.type === 'refused') this.refuse(message.failure);
  }

  /** The answer; null when there is none, or when it comes too late for what is shown by now. */
  private async answer<Answer>(question: Promise<Answer>): Promise<Answer | null> {
    const { request } = this;
    const isCurrent = () => request === this.request;
    const answer = await answerOf(question, (failure) => isCurrent() && this.refuse(failure));
    return isCurrent() ? answer : null;
  }

  private refuse(failure: Failure): void {
    this.isWaiting = false;
    this.isStepping = false;
    const problem = { source: 'setting', sentence: sentenceOf(failure) } as const;
    this.store.set({ phase: 'refused', playing: false, problem });
  }

  private scalar(): Scalar {
    return shownHeat(this.store.get()) === 'distance' ? 'distance' : 'stretch';
  }

  private async load(): Promise<void> {
    const { numbers, phase, setting, mesh } = this.store.get();
    const content: Content = { setting, mesh };
    const isMoving = phase !== 'stopped' && (numbers?.time_s ?? 0) > 0;
    const keepMotion = isMoving && canKeepMotion(this.loaded, content);
    this.aheadSinceMs = null;
    this.isWaiting = true;
    this.request += 1;
    const { request } = this;
    this.store.set({ phase: 'loading', held: false, ahead: null });
    if (setting.preset === 'obj' && !mesh) return this.obj.bringExample();
    const scalar = this.scalar();
    await this.reload({ type: 'load', ...loadOf(content), keepMotion, request, scalar }, content);
  }

  private async reload(question: Reload, content: Content): Promise<void> {
    this.isWaiting = true;
    const message = await this.answer(this.client.ask(question));
    if (message) this.receiveLoaded(message, content);
  }

  private receiveLoaded(message: LoadedMessage, content: Content): void {
    const isNewScene = !isSameScene(this.loaded, content);
    this.loaded = content;
    this.isWaiting = false;
    this.isStepping = false;
    this.frames.replace(message.buffers, message.scalar);
    this.clock.restart(message.numbers.time_s);
    this.timer.clear();
    this.timer.feed(message.numbers);
    this.view.showMesh(message.triangles, message.summary.n_vertices, isNewScene);
    this.showFrame();
    const { problem, startS } = this.store.get();
    const isSolved = problem !== null && ['setting', 'run', 'file'].includes(problem.source);
    this.store.set({
      phase: 'ready',
      summary: message.summary,
      numbers: message.numbers,
      colliders: message.colliders,
      timing: null,
      isCutShort: false,
      pace: null,
      problem: isSolved ? null : problem,
    });
    void this.bringReference();
    if (message.numbers.time_s === 0 && startS > 0) {
      this.aheadSinceMs = performance.now();
      this.runAhead();
    }
    this.refill();
  }

  private showFrame(): void {
    const { shown, scalar } = this.frames;
    if (shown) this.view.showFrame(shown, scalar);
  }

  /** Fetches what the shown cloth is compared with; without it there is no error, and no harm. */
  private async bringReference(): Promise<void> {
    const url = this.loaded && referenceUrl(this.loaded.setting);
    if (!url || url === this.referenceAt || navigator.onLine === false) return;
    this.referenceAt = url;
    try {
      const answer = await fetch(url);
      if (!answer.ok) throw new Error(answer.statusText);
      const bytes = await answer.arrayBuffer();
      if (this.referenceAt === url) await this.setReference(bytes);
    } catch {
      if (this.referenceAt === url) this.referenceAt = null; // the next load tries again
    }
  }

  private async setReference(bytes: ArrayBuffer): Promise<void> {
    const question = this.client.ask({ type: 'setReference', bytes }, [bytes]);
    const answer = await answerOf(question, (failure) => this.refuse(failure));
    if (answer?.type === 'referenceSet' && !this.isWaiting)
      this.store.set({ numbers: answer.numbers });
  }

  /** Has the frame that stands filled with the number that the colours show. */
  private refill(): void {
    const isFree = !this.isWaiting && !this.isStepping && this.aheadSinceMs === null;
    if (!isFree || this.store.get().phase !== 'ready') return;
    if (this.frames.scalar !== this.scalar()) void this.send(0);
  }

  /** Takes the next steps towards the start time, or shows the frame when there. */
  private runAhead(): void {
    const { startS, numbers, summary, timing, playing } = this.store.get();
    if (this.aheadSinceMs === null || !numbers || !summary) return;
    const { step_s: stepS } = summary;
    const left = Math.round((startS - numbers.time_s) / stepS);
    const isLate = performance.now() - this.aheadSinceMs > LONGEST_AHEAD_MS;
    if (left > 0 && !isLate && !playing) {
      this.store.set({ ahead: numbers.time_s / startS });
      const msPerStep = timing?.totalMs ?? EXPECTED_STEP_MS;
      return void this.send(this.clock.takeOf(left, stepS, msPerStep));
    }
    this.aheadSinceMs = null;
    this.showFrame();
    this.store.set({ ahead: null });
    this.refill();
  }

  private receiveReport({ numbers, status }: RunReport): void {
    const patch: Partial<MotionState> = { numbers, isCutShort: status === 'not_converged' };
    const timing = this.timer.feed(numbers);
    if (timing) patch.timing = timing;
    const pace = this.store.get().playing ? this.clock.pace(numbers.time_s) : null;
    if (pace !== null) patch.pace = pace;
    this.store.set(patch);
  }

  private receiveFrame({ buffer, scalar, hasEnded, report, colliders }: FrameMessage): void {
    this.isStepping = false;
    this.frames.show(buffer, scalar);
    if (this.aheadSinceMs === null || hasEnded) this.showFrame();
    if (colliders.length > 0) this.store.set({ colliders });
    if (report) this.receiveReport(report);
    if (hasEnded) return this.end(endOf(report, buffer));
    if (this.aheadSinceMs !== null) return this.runAhead();
    this.goOn();
    this.refill();
  }

  private end(sentence: string): void {
    this.aheadSinceMs = null;
    const problem = { source: 'run', sentence } as const;
    this.store.set({ phase: 'stopped', playing: false, held: false, ahead: null, problem });
  }

  private async send(count: number): Promise<void> {
    const buffer = this.frames.take();
    if (!buffer) return;
    const wantsNumbers = this.clock.areNumbersDue(!this.store.get().playing);
    this.isStepping = true;
    const { request } = this;
    const scalar = this.scalar();
    const question = { type: 'step', count, wantsNumbers, request, scalar, buffer } as const;
    const frame = await this.answer(this.client.ask(question, [buffer]));
    if (frame?.type === 'frame') this.receiveFrame(frame);
  }

  /** Asks for the steps that are due by the clock; called at each frame and at each answer. */
  private goOn(): void {
    const { playing, speed, summary, timing } = this.store.get();
    if (!playing || !summary) return;
    this.clock.tick(speed);
    if (this.isWaiting || this.isStepping || this.aheadSinceMs !== null) return;
    const count = this.clock.take(summary.step_s, timing?.totalMs ?? null);
    if (count > 0) void this.send(count);
  }

  private startClock(): void {
    const tick = (): void => {
      this.goOn();
      if (this.store.get().playing) this.tickHandle = requestAnimationFrame(tick);
    };
    this.clock.restart(this.store.get().numbers?.time_s ?? 0);
    cancelAnimationFrame(this.tickHandle);
    this.tickHandle = requestAnimationFrame(tick);
  }
}
