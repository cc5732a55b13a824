// What the workers do with each message, as a function of the module and of where answers go.
// The only file that calls delete() on theirs.
import {
  describe,
  type Failure,
  internalFailure,
  type RunStatus,
  read,
} from '../../shared/bindings/answers';
import { FLOATS_PER_VERTEX, frameViews, type Scalar } from '../../shared/bindings/frame';
import type { Collider } from '../../shared/bindings/geometry';
import type {
  ObjAnswer,
  PleatModule,
  RunNumbers,
  SceneSummary,
  SimulationHandle,
} from '../bindings/pleat-module';
import type { SweepModule, SweepReport } from '../bindings/sweep-module';
import { DIRECTIONS, liesFlat, objMesh } from '../state/obj-mesh';
import type {
  LoadMessage,
  Post,
  RunReport,
  StepMessage,
  SweepMessage,
  ToMotion,
} from './motion-protocol';

/** Work between two progress reports of a sweep [ms]; short enough that progress looks alive. */
const SWEEP_SLICE_MS = 150;

/** Copies the present frame; the one copy on its way to the screen. NaN: there is no such number. */
function fill(simulation: SimulationHandle, buffer: ArrayBuffer, scalar: Scalar): void {
  const views = frameViews(buffer);
  views.positions.set(simulation.positions());
  const values = scalar === 'distance' ? simulation.distances() : simulation.stretch();
  if (values.length === views.scalar.length) views.scalar.set(values);
  else views.scalar.fill(Number.NaN);
}

function readNumbers(simulation: SimulationHandle): RunNumbers | null {
  const numbers = read<RunNumbers>(simulation.numbers());
  return numbers.ok ? numbers : null;
}

function readReport(simulation: SimulationHandle): RunReport | null {
  const numbers = readNumbers(simulation);
  const status = read<RunStatus>(simulation.status());
  if (!numbers || !status.ok) return null;
  return { numbers, status: status.status, message: status.message };
}

function readColliders(simulation: SimulationHandle): Collider[] {
  const answer = read<{ colliders: Collider[] }>(simulation.colliders());
  return answer.ok ? answer.colliders : [];
}

/** Serves one page. Call `receive` with each message, `close` at the end. */
export function createMotionCore(
  module: PleatModule,
  post: Post,
): { receive: (message: ToMotion) => void; close: () => void } {
  let fabricsText: string | null = null;
  let simulation: SimulationHandle | null = null;
  let loaded: SceneSummary | null = null;
  let isHeld = false;

  function refuse(request: number, failure: Failure): void {
    post({ type: 'refused', request, failure }, []);
  }

  /** Sends everything the page draws from, with two fresh buffers, the first one filled. */
  function postLoaded(
    { request, scalar = 'stretch' }: { request: number; scalar?: Scalar },
    run: SimulationHandle,
    summary: SceneSummary,
  ): void {
    const numbers = readNumbers(run);
    if (!numbers) return refuse(request, internalFailure('no numbers after a load'));
    const nBytes = 4 * FLOATS_PER_VERTEX * summary.n_vertices;
    const buffers: [ArrayBuffer, ArrayBuffer] = [new ArrayBuffer(nBytes), new ArrayBuffer(nBytes)];
    fill(run, buffers[0], scalar);
    const triangles = run.triangles().slice();
    const colliders = readColliders(run);
    post({ type: 'loaded', request, summary, triangles, buffers, scalar, numbers, colliders }, [
      triangles.buffer,
      ...buffers,
    ]);
  }

  function load(run: SimulationHandle, message: LoadMessage): void {
    const { sceneText, keepMotion, request, start } = message;
    const text = keepMotion && loaded ? run.carryOver(sceneText) : run.load(sceneText);
    const answer = read<{ summary: SceneSummary }>(text);
    if (!answer.ok) return refuse(request, answer);
    const started = read<object>(start ? run.startFrom(start) : '{"ok": true}');
    if (!started.ok) return refuse(request, started);
    loaded = answer.summary;
    postLoaded(message, run, loaded);
  }

  function reset(run: SimulationHandle, message: Extract<ToMotion, { type: 'reset' }>): void {
    if (!loaded) return refuse(message.request, internalFailure('reset before load'));
    const answer = read<object>(run.reset());
    if (!answer.ok) return refuse(message.request, answer);
    postLoaded(message, run, loaded);
  }

  /** One that cannot be read is none: the page goes without. */
  function setReference(run: SimulationHandle, bytes: ArrayBuffer): void {
    const answer = read<object>(run.setReference(new Uint8Array(bytes)));
    const numbers = answer.ok && loaded ? readNumbers(run) : null;
    if (numbers) post({ type: 'referenceSet', numbers }, []);
  }

  function step(run: SimulationHandle, message: StepMessage): void {
    const { buffer, count, request, scalar = 'stretch' } = message;
    // A buffer of another size belongs to the mesh before the last load: nothing to fill.
    if (!loaded || buffer.byteLength !== 4 * FLOATS_PER_VERTEX * loaded.n_vertices) return;
    const code = run.step(count);
    fill(run, buffer, scalar);
    const hasEnded = code !== 0;
    const report = hasEnded || message.wantsNumbers ? readReport(run) : null;
    const colliders = readColliders(run);
    post({ type: 'frame', request, count, buffer, scalar, hasEnded, report, colliders }, [buffer]);
  }

  function readObj(text: string, message: Extract<ToMotion, { type: 'readObj' }>): void {
    const { name, objText, isOwn } = message;
    const scene = new module.Scene(text);
    const readAlong = (threads: keyof typeof DIRECTIONS) => {
      const meshText = JSON.stringify({ obj: name, warp_direction: DIRECTIONS[threads] });
      return { threads, answer: read<ObjAnswer>(scene.readObj(objText, meshText)) };
    };
    try {
      let { threads, answer } = readAlong('down');
      const isFlat = answer.ok && liesFlat({ low: answer.low_m, high: answer.high_m });
      if (answer.ok && answer.needs_direction && isFlat)
        ({ threads, answer } = readAlong('along_x'));
      if (!answer.ok) return post({ type: 'objRefused', failure: answer }, []);
      const known = answer.needs_direction ? threads : 'texture';
      post({ type: 'objRead', mesh: objMesh({ name, isOwn, threads: known }, answer) }, []);
    } finally {
      scene.delete();
    }
  }

  function open(text: string): void {
    simulation?.delete();
    fabricsText = text;
    simulation = new module.Simulation(text);
    loaded = null;
    post({ type: 'ready' }, []);
  }

  function handle(message: ToMotion): void {
    if (message.type === 'open') return open(message.fabricsText);
    if (!simulation || fabricsText === null) throw new Error(`${message.type} before open`);
    switch (message.type) {
      case 'readObj':
        return readObj(fabricsText, message);
      case 'load':
        isHeld = false;
        return load(simulation, message);
      case 'reset':
        isHeld = false;
        return reset(simulation, message);
      case 'setReference':
        return setReference(simulation, message.bytes);
      case 'step':
        return step(simulation, message);
      case 'grab':
        isHeld = loaded !== null && read<object>(simulation.grab(message.vertex)).ok;
        return;
      case 'moveGrab':
        if (isHeld) simulation.moveGrab(...message.target);
        return;
      case 'releaseGrab':
        if (isHeld) simulation.releaseGrab();
        isHeld = false;
        return;
    }
  }

  return {
    receive(message) {
      try {
        handle(message);
      } catch (error) {
        const request = 'request' in message ? message.request : -1;
        refuse(request, internalFailure(describe(error)));
      }
    },
    close() {
      simulation?.delete();
      simulation = null;
    },
  };
}

/** Runs a sweep to its end, and reports as it goes. */
export function runSweep(module: SweepModule, message: SweepMessage, post: Post): void {
  const refuse = (failure: Failure) => post({ type: 'refused', request: -1, failure }, []);
  const experiment = new module.Experiment(message.fabricsText);
  try {
    const started = read<object>(experiment.start(message.planText));
    if (!started.ok) return refuse(started);
    for (let done = false; !done; ) {
      const report = read<SweepReport>(experiment.advance(SWEEP_SLICE_MS));
      if (!report.ok) return refuse(report);
      post({ type: 'sweepReport', report }, []);
      done = report.done;
    }
  } catch (error) {
    refuse(internalFailure(describe(error)));
  } finally {
    experiment.delete();
  }
}
