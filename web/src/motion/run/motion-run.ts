// Runs the shown cloth: turns changes of the state into questions to its worker, and answers into state and frames.
import { brokenSentence, type Failure, sentenceOf } from '../../shared/bindings/answers';
import { frameViews, type Scalar } from '../../shared/bindings/frame';
import type { Triple } from '../../shared/bindings/geometry';
import type { EnergyNumbers, ImexShare } from '../../shared/bindings/pleat-module';
import { affordable, createClock } from '../../shared/state/clock';
import { Latest } from '../../shared/state/latest';
import type { Store } from '../../shared/state/store';
import { answerOf } from '../../shared/workers/asked';
import { type StartMotion, startMotionWorker } from '../../shared/workers/motion-client';
import type {
  FrameMessage,
  FromMotion,
  LevelsMessage,
  LoadedMessage,
  ToMotion,
  TornMesh,
} from '../../shared/workers/motion-protocol';
import type { LevelWish } from '../state/coarse-levels';
import { withSample } from '../state/energy-samples';
import {
  type MotionState,
  type Remedy,
  shownHeat,
  type Way,
  wantsReference,
} from '../state/motion-state';
import { presetSetting, type Setting } from '../state/setting';
import { stepCostAt, withCost } from '../state/step-cost';
import { later } from './later';
import type { StartObj } from './obj-client';
import { createLaterObj, type LaterObj } from './obj-later';
import { ReferenceSource } from './reference-source';
import { type Content, canKeepMotion, isSameScene, loadOf, wayTo } from './run-content';
import { RunFrames } from './run-frames';
import { RunReading } from './run-reading';
import { backWords, endOf, workWords } from './run-words';
import { RunWorker, type Work } from './run-worker';

/** Numbers are read and shown this often [ms]: faster cannot be read. */
const NUMBERS_EVERY_MS = 200;

/** Time of a step that is expected before one was measured [ms]. */
const EXPECTED_STEP_MS = 10;

/** Work that takes longer is shown, and can be stopped [ms]. */
const SHOWN_WORK_MS = 500;

/** An account of energy has a sample at least this often on the way to the start [s]. */
const SAMPLE_EVERY_S = 1 / 60;

/** How often a run that is to rest is looked at [ms]. */
const REST_POLL_MS = 20;

/** A reset or another scene waits this long for a step; then the worker is ended [ms]. */
const PATIENCE_MS = 1000;
/** And a change that takes the motion over, which it loses then [ms]. */
const MOVING_PATIENCE_MS = 5000;

/** Kind of a new mesh: of another scene, of the same one, or of the same cloth, torn. */
export type MeshChange = 'scene' | 'mesh' | 'tear';

export interface MotionRunView {
  /** A new mesh; its first frame follows at once. */
  showMesh(triangles: Uint32Array, nVertices: number, change: MeshChange): void;
  /** The buffer stays valid until the next call. */
  showFrame(buffer: ArrayBuffer, scalar: Scalar): void;
}

type Reload = Extract<ToMotion, { type: 'load' | 'reset' }>;

/** The question that the worker is asked: a new mesh, one that keeps the motion, steps, or nothing. */
type Doing = 'load' | 'carryOver' | 'step' | 'nothing';

/** Loads the state's setting into its worker, and follows the store from then on. */
export class MotionRun {
  readonly obj: LaterObj;
  private readonly bringRemedies: () => Promise<typeof import('./remedy') | null>;
  private readonly worker: RunWorker;
  private readonly reference: ReferenceSource;
  private readonly clock = createClock();
  private readonly frames = new RunFrames();
  private readonly reading = new RunReading();
  private readonly latest = new Latest(); // load or reset
  private doing: Doing = 'nothing';
  private areNumbersOld = false; // they are not those of the shown frame
  private lacksEnergy = false; // the account of energy is open, but its begin was not read
  private isAhead = false; // running to the start, nothing is shown
  private isRecovering = false; // started again after an end, and no step since
  private startsAnew = false; // the next load keeps no motion
  private from: Way | null = null; // state from which it goes on, in place of the shown one
  private loaded: Content | null = null; // content that the worker has
  private seen: Content | null = null; // content of the picture
  private proven: Content | null = null; // the last one whose steps came without a wait

  constructor(
    private readonly store: Store<MotionState>,
    private readonly view: MotionRunView,
    start: StartMotion = startMotionWorker,
    startObj?: StartObj,
  ) {
    this.worker = new RunWorker(start, {
      news: (message) => this.hear(message),
      broken: (reason, hasStarted) => this.breakDown(reason, hasStarted),
      atWork: (work) => this.watchWork(work),
    });
    this.obj = createLaterObj(store, startObj, () => void this.load());
    this.bringRemedies = later(store, 'What helps here', () => import('./remedy'));
    this.reference = new ReferenceSource(store, this.worker, (numbers) => {
      if (!this.isLoading) store.set({ numbers });
    });
    store.subscribe((state, previous) => {
      if (state.setting !== previous.setting && state.phase !== 'broken') void this.load();
      if (state.playing && !previous.playing) this.startClock();
      if (wantsReference(state) && !wantsReference(previous)) this.bringReference();
      if (state.springs && !previous.springs) void this.bringSprings();
      if (state.energy !== previous.energy) this.beginAccount();
      const isPaused = !state.playing && previous.playing;
      if (isPaused || shownHeat(state) !== shownHeat(previous)) this.refill();
    });
    void this.load();
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
    if (this.store.get().phase === 'ready' && this.doing === 'nothing') void this.send(1);
  }

  reset(): void {
    const { phase, setting } = this.store.get();
    if (phase === 'broken') return;
    this.isAhead = false;
    this.startsAnew = true;
    this.store.set({ playing: false, held: false, phase: 'loading', startSteps: 0, ahead: null });
    if (this.loaded?.setting !== setting) return void this.load();
    this.latest.start();
    const question = { type: 'reset', scalar: this.scalar() } as const;
    this.doing = 'load';
    void this.reload(question, this.loaded, null);
  }

  /** Shows a setting from its start, run to as many steps as the patch says, whatever moved before. */
  showAnew(patch: Partial<MotionState> & Pick<MotionState, 'setting' | 'startSteps'>): void {
    this.startsAnew = true;
    this.store.set({ playing: false, ...patch, setting: { ...patch.setting } });
  }

  /** Shows the setting that helps: from its start, from a state of this run, or in the motion that there is. */
  take({ setting, startsAnew, from }: Remedy): void {
    const plays = { setting, playing: true, problem: null };
    if (startsAnew) return this.showAnew({ ...plays, startSteps: 0 });
    this.from = from ?? null;
    this.store.set(from ? { ...plays, course: from.course } : { setting });
  }

  /** Pauses; what the state says is of the shown frame then. */
  async rest(): Promise<void> {
    this.pause();
    while (!this.isAhead && (this.doing === 'step' || this.areNumbersOld))
      await new Promise((resume) => setTimeout(resume, REST_POLL_MS));
  }

  /** Tries again to bring what the cloth is compared with. */
  bringReference(): void {
    if (this.store.get().phase === 'ready') void this.reference.bring();
  }

  /** Ends what takes long: the way to the start where it is, else the worker, for the last good setting. */
  stopWork(): void {
    const { ahead, busy, numbers, summary, startSteps, setting } = this.store.get();
    if (!busy) {
      if (ahead === null || !numbers || !summary) return;
      const endS = (startSteps * summary.step_s).toFixed(2);
      const sentence = `Stopped at ${numbers.time_s.toFixed(2)} s, on the way to ${endS} s.`;
      this.endAhead();
      return this.store.set({ problem: { source: 'link', sentence } });
    }
    if (busy.type === 'step' && this.isLoading) return this.loadAtOnce(1000 * busy.seconds);
    if (busy.type === 'step') this.noteLeastCost(1000 * busy.seconds);
    if (busy.type === 'readLevels') this.store.set({ coarse: 0 });
    const again = this.lastGood();
    const stopped = `${workWords(busy.type, setting)} was stopped after ${busy.seconds} s.`;
    this.startAgain(again, stopped);
  }

  /** How imex would take the loaded springs with such a setting; null when that comes too late. */
  implicitShare({ stepS, substeps, explicitShare }: Setting): Promise<ImexShare | null> {
    const method = { stepS, substeps, explicitShare };
    return this.answer(this.worker.ask({ type: 'readImplicitShare', ...method }));
  }

  /** Coarser levels of the loaded mesh; null when that comes too late. */
  levels(wish: LevelWish): Promise<LevelsMessage | null> {
    return this.answer(this.worker.ask({ type: 'readLevels', ...wish }));
  }

  grab(vertex: number): void {
    this.worker.tell({ type: 'grab', vertex });
    this.store.set({ held: true, astray: 'pulled' });
    void this.bringSprings();
  }

  moveGrab(target: Triple): void {
    this.worker.tell({ type: 'moveGrab', target });
  }

  releaseGrab(): void {
    this.worker.tell({ type: 'releaseGrab' });
    this.store.set({ held: false });
    void this.bringSprings();
  }

  private get isLoading(): boolean {
    return this.doing === 'load' || this.doing === 'carryOver';
  }

  /** Asks which springs are implicit, while that is drawn: it changes with mesh, step, and what is held. */
  private async bringSprings(): Promise<void> {
    const { phase, springs } = this.store.get();
    if (phase !== 'ready' || !springs) return;
    const answer = await this.answer(this.worker.ask({ type: 'readSprings' }));
    if (!answer) return;
    const { ends, isImplicit } = answer;
    this.store.set({ springSplit: { ends, isImplicit } });
  }

  /** The account of energy begins with the frame that stands, or is closed. */
  private beginAccount(): void {
    this.lacksEnergy = this.store.get().energy;
    this.store.set({ energies: [] });
    this.refill();
  }

  private hear(message: FromMotion): void {
    if (message.type === 'refused') void this.refuse(message.failure);
  }

  /** The worker is gone, or of no use any more: another one takes its place, once. */
  private breakDown(reason: string, hasStarted: boolean): void {
    const { numbers, setting } = this.store.get();
    if (!hasStarted) {
      const sentence = brokenSentence('The cloth', reason);
      this.store.set({ phase: 'broken', playing: false, problem: { source: 'browser', sentence } });
      return;
    }
    const at = numbers ? ` after step ${numbers.step}` : '';
    const ended = `The computation ended by itself${at} (${reason.replace(/[.]$/, '')}).`;
    if (this.isRecovering) return this.giveUp(ended);
    this.isRecovering = true;
    const again = this.loaded?.setting === setting ? this.loaded : this.lastGood();
    this.startAgain(again, `${ended} It was started again.`);
  }

  private giveUp(ended: string): void {
    this.isRecovering = false;
    this.replaceWorker();
    this.end(`${ended} That happened twice. Choose another setting, or reset to try once more.`);
  }

  /** The content that ran last without a wait in this scene, or the one that the scene is made for. */
  private lastGood(): Content {
    const { setting, mesh } = this.store.get();
    const own = { setting: presetSetting(setting.preset), mesh };
    return this.proven && isSameScene(this.proven, own) ? this.proven : own;
  }

  private replaceWorker(): void {
    this.worker.replace();
    this.reference.forget();
    this.loaded = null;
    this.latest.start();
    this.doing = 'nothing';
  }

  /** Another worker starts with this content, for the reason `why`. */
  private startAgain(content: Content, why: string): void {
    this.replaceWorker();
    this.startsAnew = true;
    const { setting, mesh } = content;
    const isProven = content === this.proven;
    const sentence = `${why} ${backWords(this.store.get().setting, setting, isProven)}`;
    const problem = { source: 'worker', sentence } as const;
    const rest = { playing: false, startSteps: 0, held: false, busy: null } as const;
    this.store.set({ ...rest, phase: 'loading', problem, mesh, setting: { ...setting } });
  }

  private watchWork(work: Work | null): void {
    const isLong = work !== null && work.forMs > SHOWN_WORK_MS;
    const patienceMs = this.doing === 'carryOver' ? MOVING_PATIENCE_MS : PATIENCE_MS;
    if (work?.type === 'step' && this.isLoading && work.forMs > patienceMs)
      return this.loadAtOnce(work.forMs);
    const busy = isLong ? { type: work.type, seconds: Math.floor(work.forMs / 1000) } : null;
    const { busy: shown } = this.store.get();
    if (busy?.type !== shown?.type || busy?.seconds !== shown?.seconds) this.store.set({ busy });
  }

  /** Loads what is wanted without waiting for a step that has taken so long by now. */
  private loadAtOnce(forMs: number): void {
    this.noteLeastCost(forMs);
    this.replaceWorker();
    void this.load();
  }

  /** A step of the loaded setting takes longer than that. */
  private noteLeastCost(ms: number): void {
    if (!this.loaded) return;
    const { costs } = this.store.get();
    const { setting } = this.loaded;
    if (Number(stepCostAt(costs, setting, setting.level)?.ms) > ms) return; // more was known
    this.store.set({ costs: withCost(costs, setting, ms, { isLeast: true }) });
  }

  /** The answer; null when there is none, or when it comes too late for what is shown by now. */
  private async answer<Answer>(question: Promise<Answer>): Promise<Answer | null> {
    const isCurrent = this.latest.mark();
    const answer = await answerOf(question, (failure) => isCurrent() && void this.refuse(failure));
    return isCurrent() ? answer : null;
  }

  private async refuse(failure: Failure): Promise<void> {
    if (failure.kind === 'internal') return this.breakDown(failure.what, true);
    this.doing = 'nothing';
    const isCurrent = this.latest.mark();
    const remedies = await this.bringRemedies();
    if (!isCurrent()) return;
    const { setting, mesh } = this.store.get();
    const known = remedies?.remedyFor(failure, setting);
    const sentence = known?.sentence ?? sentenceOf(failure);
    const problem = { source: 'setting', sentence, remedy: known?.remedy } as const;
    this.store.set({ phase: 'refused', playing: false, problem });
    if (this.loaded) return;
    const shown = known?.remedy.setting ?? presetSetting(setting.preset);
    void this.showStandIn({ setting: shown, mesh });
  }

  /** The picture of a cloth at its start, for one that cannot be run: the stage is not left empty. */
  private async showStandIn(content: Content): Promise<void> {
    const isCurrent = this.latest.mark();
    const question = { type: 'load', ...loadOf(content), keepMotion: false } as const;
    const message = await answerOf(this.worker.ask(question), () => undefined);
    if (!message || !isCurrent()) return;
    this.showLoaded(message, content);
    this.store.set({ colliders: message.colliders });
  }

  private scalar(): Scalar {
    return shownHeat(this.store.get()) === 'distance' ? 'distance' : 'stretch';
  }

  private async load(): Promise<void> {
    const { numbers, phase, setting, mesh, astray } = this.store.get();
    const content: Content = { setting, mesh };
    const isMoving = phase !== 'stopped' && (numbers?.time_s ?? 0) > 0;
    const { from, startsAnew } = this;
    const isCarried = isMoving && !startsAnew && canKeepMotion(this.loaded, content);
    const keepMotion = isCarried || from !== null;
    this.startsAnew = false;
    this.from = null;
    this.isAhead = false;
    this.doing = keepMotion ? 'carryOver' : 'load';
    this.latest.start();
    this.store.set({ phase: 'loading', held: false, ahead: null });
    if (setting.preset === 'obj' && !mesh) return this.obj.bringExample();
    const scalar = this.scalar();
    const way = from ? wayTo(from) : [];
    const question = { type: 'load', ...loadOf(content), keepMotion, scalar, way } as const;
    await this.reload(question, content, keepMotion ? (astray ?? 'changed') : null);
  }

  private async reload(
    question: Reload,
    content: Content,
    astray: MotionState['astray'],
  ): Promise<void> {
    const message = await this.answer(this.worker.ask(question));
    if (message) this.receiveLoaded(message, content, astray);
  }

  private showLoaded(message: LoadedMessage, content: Content): void {
    const isNewScene = !isSameScene(this.seen, content);
    this.loaded = content;
    this.seen = content;
    this.frames.replace(message.buffers, message.scalar);
    const change = isNewScene ? 'scene' : 'mesh';
    this.view.showMesh(message.triangles, message.summary.n_vertices, change);
    this.showFrame();
  }

  private receiveLoaded(
    message: LoadedMessage,
    content: Content,
    astray: MotionState['astray'],
  ): void {
    this.startsAnew = false;
    this.doing = 'nothing';
    this.areNumbersOld = false;
    this.clock.restart();
    this.reading.begin(message.numbers);
    this.showLoaded(message, content);
    const { problem, startSteps, energy, course } = this.store.get();
    const { time_s, step } = message.numbers;
    this.lacksEnergy = energy;
    const isSolved = problem !== null && ['setting', 'run', 'file'].includes(problem.source);
    this.store.set({
      phase: 'ready',
      summary: message.summary,
      numbers: message.numbers,
      colliders: message.colliders,
      timing: null,
      energies: [],
      isCutShort: false,
      pace: null,
      astray: time_s > 0 ? astray : null, // torn cloth begins anew
      course: [...(time_s > 0 ? course : []), { ...content, fromStep: step }],
      problem: isSolved ? null : problem,
    });
    this.bringReference();
    void this.bringSprings();
    if (time_s === 0 && startSteps > 0) {
      this.isAhead = true;
      this.runAhead();
    }
    this.refill();
  }

  private showFrame(): void {
    const { shown, scalar } = this.frames;
    if (shown) this.view.showFrame(shown, scalar);
  }

  /** Has the frame that stands filled with the number that the colours show, and its numbers read. */
  private refill(): void {
    const { phase, playing } = this.store.get();
    if (this.doing !== 'nothing' || this.isAhead || phase !== 'ready') return;
    const isBehind = (this.areNumbersOld && !playing) || this.lacksEnergy;
    if (isBehind || this.frames.scalar !== this.scalar()) void this.send(0);
  }

  /** Takes the next steps towards the start, or shows the frame when there. */
  private runAhead(): void {
    const { startSteps, numbers, summary, timing, playing, energy } = this.store.get();
    if (!this.isAhead || !numbers || !summary) return;
    const left = startSteps - numbers.step;
    if (left <= 0 || playing) return this.endAhead();
    if (this.lacksEnergy) return void this.send(0);
    this.store.set({ ahead: numbers.step / startSteps });
    const msPerStep = timing?.totalMs ?? EXPECTED_STEP_MS;
    const atOnce = energy ? Math.max(1, Math.round(SAMPLE_EVERY_S / summary.step_s)) : left;
    void this.send(Math.min(left, atOnce, affordable(msPerStep)));
  }

  private endAhead(): void {
    this.isAhead = false;
    this.showFrame();
    this.store.set({ ahead: null });
    this.refill();
  }

  private addSample(sample: EnergyNumbers): void {
    const { energy, energies } = this.store.get();
    if (!energy) return;
    this.lacksEnergy = false;
    this.store.set({ energies: withSample(energies, sample) });
  }

  /** The mesh that a tear has made, in which a hand goes on holding what it holds. */
  private showTorn({ buffer, scalar }: FrameMessage, { triangles, spare }: TornMesh): void {
    const n_vertices = frameViews(buffer).scalar.length;
    this.frames.replace([buffer, spare], scalar);
    this.view.showMesh(triangles, n_vertices, 'tear');
    const { summary } = this.store.get();
    if (summary) this.store.set({ summary: { ...summary, n_vertices } });
    void this.bringSprings();
  }

  private receiveFrame(frame: FrameMessage): void {
    const { buffer, torn, scalar, hasEnded, report, energy, colliders } = frame;
    this.doing = 'nothing';
    if (energy) this.addSample(energy);
    if (torn) this.showTorn(frame, torn);
    else this.frames.show(buffer, scalar);
    if (torn || !this.isAhead || hasEnded) this.showFrame();
    if (colliders.length > 0) this.store.set({ colliders });
    this.areNumbersOld = report === null;
    if (report)
      this.store.set(this.reading.patchOf(report, this.store.get(), this.loaded?.setting));
    if (hasEnded) return this.end(endOf(report, buffer));
    if (this.isAhead) return this.runAhead();
    this.goOn();
    this.refill();
  }

  private end(sentence: string): void {
    this.isAhead = false;
    const problem = { source: 'run', sentence } as const;
    this.store.set({ phase: 'stopped', playing: false, held: false, ahead: null, problem });
  }

  private async send(count: number): Promise<void> {
    const buffer = this.frames.take();
    if (!buffer) return;
    const { playing, energy: wantsEnergy } = this.store.get();
    const wantsNumbers = this.clock.areNumbersDue(NUMBERS_EVERY_MS, !playing);
    this.doing = 'step';
    const scalar = this.scalar();
    const beginMs = performance.now();
    const wants = { wantsNumbers, wantsEnergy, scalar };
    const question = { type: 'step', count, buffer, ...wants } as const;
    const frame = await this.answer(this.worker.ask(question, [buffer]));
    if (frame?.type !== 'frame') return;
    if (count > 0 && performance.now() - beginMs < PATIENCE_MS) {
      this.proven = this.loaded;
      this.isRecovering = false;
    }
    this.receiveFrame(frame);
  }

  /** Asks for the steps that are due by the clock; called at each frame and at each answer. */
  private goOn(): void {
    const { playing, speed, summary, timing } = this.store.get();
    if (!playing || !summary) return;
    this.clock.tick(speed);
    if (this.doing !== 'nothing' || this.isAhead) return;
    if (this.lacksEnergy) return void this.send(0);
    const count = this.clock.take(summary.step_s, affordable(timing?.totalMs ?? null));
    if (count > 0) void this.send(count);
  }

  private startClock(): void {
    this.reading.restartPace(this.store.get().numbers?.time_s ?? 0);
    this.clock.start(() => {
      this.goOn();
      return this.store.get().playing;
    });
  }
}
