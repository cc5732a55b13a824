// Runs the shown cloth: turns changes of the state into messages, and answers into state and frames.
import exampleUrl from '../../../../assets/meshes/skirt.obj?url';
import { brokenSentence, type Failure } from '../../shared/bindings/answers';
import { frameViews, type Scalar } from '../../shared/bindings/frame';
import type { Triple } from '../../shared/bindings/geometry';
import { fabricsText } from '../../shared/fabric/fabric-data';
import type { Store } from '../../shared/state/store';
import { startWorker } from '../../shared/workers/client';
import { type MotionState, shownHeat } from '../state/motion-state';
import type { ObjMesh } from '../state/obj-mesh';
import { presetSetting, type Setting, sceneOf } from '../state/setting';
import type { FrameMessage, FromMotion, LoadedMessage, RunReport } from '../worker/motion-protocol';
import { createPacer } from './pacer';
import { referenceUrl } from './references';
import { createStepTimer } from './step-timing';

/** Numbers are read and shown this often [ms]: faster cannot be read. */
const NUMBERS_EVERY_MS = 200;

/** Running ahead of the first picture gives up after this much of the clock [ms]. */
const LONGEST_AHEAD_MS = 4000;

/** The pace is measured over this much of the clock [s]. */
const PACE_WINDOW_S = 1;

export interface MotionRunView {
  /** A new mesh; its first frame follows at once. */
  showMesh(triangles: Uint32Array, nVertices: number, isNewScene: boolean): void;
  /** The buffer stays valid until the next call. */
  showFrame(buffer: ArrayBuffer, scalar: Scalar): void;
}

export interface MotionRun {
  play(): void;
  pause(): void;
  step(): void;
  reset(): void;
  grab(vertex: number): void;
  moveGrab(target: Triple): void;
  releaseGrab(): void;
  /** Shows the visitor's mesh, or says what is wrong with the file while the cloth goes on. */
  openObj(file: File): Promise<void>;
}

/** What a load is of. */
interface Content {
  setting: Setting;
  mesh: ObjMesh | null;
}

function isSameScene(a: Content | null, b: Content): boolean {
  const isMesh = b.setting.preset === 'obj';
  return a?.setting.preset === b.setting.preset && (!isMesh || a.mesh === b.mesh);
}

/** A free mesh has no mesh lines to carry motion along, and tension is another in another model. */
function canKeepMotion(a: Content | null, b: Content): boolean {
  const { preset, model } = b.setting;
  return isSameScene(a, b) && preset !== 'obj' && a?.setting.model === model;
}

/** One sentence for a failure, with the place in the scene when there is one. */
function sentenceOf(failure: Failure): string {
  const place = failure.where && !failure.what.includes(failure.where) ? `${failure.where}: ` : '';
  const prefix = failure.kind === 'internal' ? 'The program failed: ' : '';
  return `${prefix}${place}${failure.what}`;
}

/** Where the vertex that a message names was in a frame, in words; nothing when it names none. */
function placeOf(message: string, frame: ArrayBuffer): string {
  const vertex = Number(/^vertex (\d+)/.exec(message)?.[1] ?? Number.NaN);
  const place = frameViews(frame).positions.subarray(3 * vertex, 3 * vertex + 3);
  if (place.length < 3) return '';
  return ` It was last at (${Array.from(place, (metres) => metres.toFixed(2)).join(', ')}) m.`;
}

/** What ended a run: in which step and where. `frame` is the last finite one. */
function endOf(report: RunReport | null, frame: ArrayBuffer): string {
  const rest = 'The last good frame stays; reset to start again.';
  if (!report) return `The run stopped without a report. ${rest}`;
  const { numbers, status, message } = report;
  const reason = `${status.replaceAll('_', ' ')}: ${message.replace(/[.]$/, '')}`;
  return `The run stopped in step ${numbers.step + 1}, ${reason}.${placeOf(message, frame)} ${rest}`;
}

/** Opens the worker, loads the state's setting, and follows the store from then on. */
export function createMotionRun(store: Store<MotionState>, view: MotionRunView): MotionRun {
  const pacer = createPacer();
  const timer = createStepTimer();
  const client = startWorker(receive, broken);
  let request = 0;
  let isWaiting = false; // for the answer to a load or a reset
  let isStepping = false;
  let shown: ArrayBuffer | null = null;
  let shownScalar: Scalar = 'stretch';
  let referenceAt: string | null = null; // that the worker has, or is about to get
  let spare: ArrayBuffer | null = null;
  let loaded: Content | null = null;
  let pending: Content | null = null;
  let aheadSinceMs: number | null = null; // running to the start time, nothing is shown
  let tickHandle = 0;
  let lastTickMs = 0;
  let lastNumbersMs = 0;
  let paceMark = { clockMs: 0, timeS: 0 };

  function broken(reason: string): void {
    const sentence = brokenSentence('The cloth', reason);
    store.set({ phase: 'broken', playing: false, problem: { source: 'browser', sentence } });
  }

  function scalar(): Scalar {
    return shownHeat(store.get()) === 'distance' ? 'distance' : 'stretch';
  }

  function load(): void {
    const { numbers, phase, setting, mesh } = store.get();
    pending = { setting, mesh };
    const isMoving = phase !== 'stopped' && (numbers?.time_s ?? 0) > 0;
    const keepMotion = isMoving && canKeepMotion(loaded, pending);
    aheadSinceMs = null;
    isWaiting = true;
    request += 1;
    store.set({ phase: 'loading', held: false, ahead: null });
    if (setting.preset === 'obj' && !mesh) return void bringExample();
    const sceneText = JSON.stringify(sceneOf(setting, mesh));
    const start = setting.preset === 'obj' && setting.level === 0 ? mesh?.start : undefined;
    client.send({ type: 'load', sceneText, keepMotion, request, scalar: scalar(), start });
  }

  /** The mesh that stands in until there is one of the visitor's. */
  async function bringExample(): Promise<void> {
    try {
      const answer = await fetch(exampleUrl);
      if (!answer.ok) throw new Error(answer.statusText);
      client.send({
        type: 'readObj',
        name: 'skirt.obj',
        objText: await answer.text(),
        isOwn: false,
      });
    } catch {
      if (store.get().setting.preset !== 'obj') return;
      const sentence =
        'The example mesh could not be fetched. Check the connection, or bring yours.';
      store.set({ phase: 'refused', playing: false, problem: { source: 'setting', sentence } });
    }
  }

  function receiveMesh(mesh: ObjMesh): void {
    const { setting, mesh: present } = store.get();
    if (mesh.isOwn) {
      const start = setting.preset === 'obj' ? setting : presetSetting('obj');
      const patch = { startS: 0, playing: false, invited: true };
      return store.set({ mesh, setting: { ...start, level: 0, hold: 'highest' }, ...patch });
    }
    if (present) return; // the visitor was quicker
    store.set({ mesh });
    if (setting.preset === 'obj') load();
  }

  function receiveLoaded(message: LoadedMessage): void {
    const isNewScene = !pending || !isSameScene(loaded, pending);
    loaded = pending;
    isWaiting = false;
    isStepping = false;
    [shown, spare] = message.buffers;
    shownScalar = message.scalar;
    pacer.clear();
    timer.clear();
    timer.feed(message.numbers);
    paceMark = { clockMs: performance.now(), timeS: message.numbers.time_s };
    view.showMesh(message.triangles, message.summary.n_vertices, isNewScene);
    view.showFrame(shown, shownScalar);
    const { problem, startS } = store.get();
    const isSolved = problem !== null && ['setting', 'run', 'file'].includes(problem.source);
    store.set({
      phase: 'ready',
      summary: message.summary,
      numbers: message.numbers,
      colliders: message.colliders,
      timing: null,
      isCutShort: false,
      pace: null,
      problem: isSolved ? null : problem,
    });
    bringReference();
    if (message.numbers.time_s === 0 && startS > 0) {
      aheadSinceMs = performance.now();
      runAhead();
    }
    refill();
  }

  /** Fetches what the shown cloth is compared with; without it there is no error, and no harm. */
  async function bringReference(): Promise<void> {
    const url = loaded && referenceUrl(loaded.setting);
    if (!url || url === referenceAt || navigator.onLine === false) return;
    referenceAt = url;
    try {
      const answer = await fetch(url);
      if (!answer.ok) throw new Error(answer.statusText);
      const bytes = await answer.arrayBuffer();
      if (referenceAt === url) client.send({ type: 'setReference', bytes }, [bytes]);
    } catch {
      if (referenceAt === url) referenceAt = null; // the next load tries again
    }
  }

  /** Has the frame that stands filled with the number that the colours show. */
  function refill(): void {
    const isFree = !isWaiting && !isStepping && aheadSinceMs === null;
    if (isFree && store.get().phase === 'ready' && shownScalar !== scalar()) send(0);
  }

  /** Takes the next steps towards the start time, or shows the frame when there. */
  function runAhead(): void {
    const { startS, numbers, summary, timing, playing } = store.get();
    if (aheadSinceMs === null || !numbers || !summary) return;
    const left = Math.round((startS - numbers.time_s) / summary.step_s);
    const isLate = performance.now() - aheadSinceMs > LONGEST_AHEAD_MS;
    if (left > 0 && !isLate && !playing) {
      pacer.clear();
      pacer.advance(left * summary.step_s);
      store.set({ ahead: numbers.time_s / startS });
      return send(pacer.take(summary.step_s, timing?.totalMs ?? 10));
    }
    aheadSinceMs = null;
    pacer.clear();
    if (shown) view.showFrame(shown, shownScalar);
    store.set({ ahead: null });
    refill();
  }

  function receiveReport({ numbers, status }: RunReport): void {
    const patch: Partial<MotionState> = { numbers, isCutShort: status === 'not_converged' };
    const timing = timer.feed(numbers);
    if (timing) patch.timing = timing;
    const now = performance.now();
    const elapsedS = (now - paceMark.clockMs) / 1000;
    if (store.get().playing && elapsedS >= PACE_WINDOW_S) {
      patch.pace = (numbers.time_s - paceMark.timeS) / elapsedS;
      paceMark = { clockMs: now, timeS: numbers.time_s };
    }
    store.set(patch);
  }

  function receiveFrame(message: FrameMessage): void {
    const { buffer, hasEnded, report, colliders } = message;
    isStepping = false;
    spare = shown;
    shown = buffer;
    shownScalar = message.scalar;
    if (aheadSinceMs === null || hasEnded) view.showFrame(shown, shownScalar);
    if (colliders.length > 0) store.set({ colliders });
    if (report) receiveReport(report);
    if (!hasEnded) {
      if (aheadSinceMs !== null) return runAhead();
      goOn();
      return refill();
    }
    aheadSinceMs = null;
    store.set({
      phase: 'stopped',
      playing: false,
      held: false,
      ahead: null,
      problem: { source: 'run', sentence: endOf(report, buffer) },
    });
  }

  function receive(message: FromMotion): void {
    switch (message.type) {
      case 'ready':
        return load();
      case 'broken':
        return broken(message.reason);
      case 'loaded':
        if (message.request === request) receiveLoaded(message);
        return;
      case 'frame':
        if (message.request === request) receiveFrame(message);
        return;
      case 'referenceSet':
        if (!isWaiting) store.set({ numbers: message.numbers });
        return;
      case 'objRead':
        return receiveMesh(message.mesh);
      case 'objRefused':
        return store.set({ problem: { source: 'file', sentence: sentenceOf(message.failure) } });
      case 'refused':
        if (message.request >= 0 && message.request !== request) return;
        isWaiting = false;
        isStepping = false;
        store.set({
          phase: 'refused',
          playing: false,
          problem: { source: 'setting', sentence: sentenceOf(message.failure) },
        });
        return;
    }
  }

  function send(count: number): void {
    if (!spare) return;
    const now = performance.now();
    const wantsNumbers = !store.get().playing || now - lastNumbersMs >= NUMBERS_EVERY_MS;
    if (wantsNumbers) lastNumbersMs = now;
    const buffer = spare;
    spare = null;
    isStepping = true;
    const message = {
      type: 'step',
      count,
      wantsNumbers,
      request,
      scalar: scalar(),
      buffer,
    } as const;
    client.send(message, [buffer]);
  }

  /** Asks for the steps that are due by the clock; called at each frame and at each answer. */
  function goOn(): void {
    const { playing, speed, summary, timing } = store.get();
    if (!playing || !summary) return;
    const nowMs = performance.now();
    pacer.advance(((nowMs - lastTickMs) / 1000) * speed);
    lastTickMs = nowMs;
    if (isWaiting || isStepping || aheadSinceMs !== null) return;
    const count = pacer.take(summary.step_s, timing?.totalMs ?? null);
    if (count > 0) send(count);
  }

  function tick(): void {
    goOn();
    if (store.get().playing) tickHandle = requestAnimationFrame(tick);
  }

  function start(): void {
    lastTickMs = performance.now();
    paceMark = { clockMs: lastTickMs, timeS: store.get().numbers?.time_s ?? 0 };
    pacer.clear();
    cancelAnimationFrame(tickHandle);
    tickHandle = requestAnimationFrame(tick);
  }

  store.subscribe((state, previous) => {
    if (state.setting !== previous.setting && state.phase !== 'broken') load();
    if (state.playing && !previous.playing) start();
    if (shownHeat(state) !== shownHeat(previous)) refill();
  });
  client.send({ type: 'open', fabricsText });

  return {
    play() {
      const { phase } = store.get();
      if (phase === 'ready' || phase === 'loading') store.set({ playing: true, invited: false });
    },
    pause() {
      store.set({ playing: false, pace: null });
    },
    step() {
      store.set({ playing: false, invited: false, pace: null });
      if (store.get().phase === 'ready' && !isWaiting && !isStepping) send(1);
    },
    reset() {
      const { phase, setting } = store.get();
      if (phase === 'broken' || !loaded) return;
      aheadSinceMs = null;
      store.set({ playing: false, held: false, phase: 'loading', startS: 0, ahead: null });
      if (loaded.setting !== setting) return load();
      request += 1;
      isWaiting = true;
      pending = loaded;
      client.send({ type: 'reset', request, scalar: scalar() });
    },
    grab(vertex) {
      client.send({ type: 'grab', vertex });
      store.set({ held: true });
    },
    moveGrab: (target) => client.send({ type: 'moveGrab', target }),
    releaseGrab() {
      client.send({ type: 'releaseGrab' });
      store.set({ held: false });
    },
    async openObj(file) {
      const { name } = file;
      const refuse = (reason: string) =>
        store.set({ problem: { source: 'file', sentence: `${name} ${reason}` } });
      if (!/\.obj$/i.test(name)) return refuse('is no OBJ file: the name does not end in .obj.');
      try {
        client.send({ type: 'readObj', name, objText: await file.text(), isOwn: true });
      } catch {
        refuse('could not be read.');
      }
    },
  };
}
