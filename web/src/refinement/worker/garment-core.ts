// What the worker of one pane does with each message, as a function of the module and of where
// answers go. The only file that calls delete() on its object.
import {
  describe,
  type Failure,
  internalFailure,
  type RunStatus,
  read,
} from '../../shared/bindings/answers';
import { FLOATS_PER_VERTEX, frameViews } from '../../shared/bindings/frame';
import type {
  FaultsAnswer,
  FitAnswer,
  GarmentCosts,
  GarmentRunHandle,
  GarmentSummary,
  RefinementModule,
  SolidsAnswer,
} from '../bindings/refinement-module';
import type { Described, FromGarment, GarmentPost, ToGarment } from './garment-protocol';
import { type Recording, readRecording } from './recording';

type Message<Type> = Extract<ToGarment, { type: Type }>;

/** Of an answer that is nothing but welcome. */
function payloadOf<Payload>(text: string): Payload | null {
  const answer = read<Payload>(text);
  return answer.ok ? answer : null;
}

/** Serves one pane. Call `receive` with each message, `close` at the end. */
export function createGarmentCore(
  module: RefinementModule,
  post: GarmentPost,
): { receive(message: ToGarment): Promise<void>; close(): void } {
  let run: GarmentRunHandle | null = null;
  let summary: GarmentSummary | null = null;
  let recording: Recording | null = null;
  let stepsPerFrame = 1;

  function refuse(request: number, failure: Failure): void {
    post({ type: 'refused', request, failure }, []);
  }

  async function load(message: Message<'load'>): Promise<void> {
    const { request, fabricsText, sceneText, files, frameS } = message;
    run ??= new module.GarmentRun(fabricsText);
    const answer = read<GarmentSummary>(run.load(sceneText, files));
    if (!answer.ok) return refuse(request, answer);
    summary = answer;
    stepsPerFrame = Math.max(1, Math.round(frameS / answer.step_s));
    const mesh = {
      triangles: run.triangles().slice(),
      triangleFaces: run.triangleFaces().slice(),
      edges: run.edges().slice(),
      hanging: run.hanging().slice(),
      faces: run.faces().slice(),
      parents: run.parents().slice(),
    };
    recording = message.recording
      ? await readRecording(new Uint8Array(message.recording), mesh.parents)
      : null;
    const head = recording?.head ?? null;
    post({ type: 'loaded', request, summary: answer, mesh, recording: head }, [
      mesh.triangles.buffer,
      mesh.triangleFaces.buffer,
      mesh.edges.buffer,
      mesh.hanging.buffer,
      mesh.faces.buffer,
      mesh.parents.buffer,
    ]);
  }

  function ended(owner: GarmentRunHandle): string {
    const status = payloadOf<RunStatus>(owner.status());
    return status ? `${status.status.replaceAll('_', ' ')}: ${status.message}` : 'no report';
  }

  function advance(owner: GarmentRunHandle, { request, frame, how }: Message<'advance'>): void {
    let reason: string | null = null;
    if (how === 'stepped' && owner.step(stepsPerFrame) !== 0) reason = ended(owner);
    if (how === 'recorded') {
      const places = recording?.frames[frame];
      if (!places || !recording) return refuse(request, internalFailure(`no frame ${frame}`));
      const { first_s: firstS, every_s: everyS } = recording.head;
      const put = read<object>(owner.put(places, firstS + frame * everyS));
      if (!put.ok) return refuse(request, put);
    }
    const isWatched = summary?.has_monitor === true && how !== 'still';
    const fit = isWatched ? payloadOf<FitAnswer>(owner.look()) : null;
    post({ type: 'advanced', request, frame, fit, ended: reason }, []);
  }

  function reset(owner: GarmentRunHandle, { request }: Message<'reset'>): void {
    const answer = read<object>(owner.reset());
    if (!answer.ok) return refuse(request, answer);
    post({ type: 'wasReset', request }, []);
  }

  /** False when there is no such number. */
  function fill(owner: GarmentRunHandle, message: Message<'describe'>, buffer: ArrayBuffer) {
    const views = frameViews(buffer);
    views.positions.set(owner.positions());
    const { scalar } = message;
    const values =
      scalar === 'curvature' ? owner.curvature() : scalar === 'distance' ? owner.distances() : null;
    if (values?.length === views.scalar.length) {
      views.scalar.set(values);
      return true;
    }
    views.scalar.fill(Number.NaN);
    return false;
  }

  function describeFrame(owner: GarmentRunHandle, message: Message<'describe'>): void {
    const { request, reference, fineLevel, timeS } = message;
    if (message.takesSample && reference) {
      const answer = read<object>(owner.putSample(reference, fineLevel, timeS));
      if (!answer.ok) return refuse(request, answer);
    }
    const isCompared = reference !== null && !message.takesSample;
    const of = (text: string) => payloadOf<{ rms_m: number }>(text)?.rms_m ?? null;
    const errorM = isCompared ? of(owner.compare(reference, fineLevel)) : null;
    const nBytes = 4 * FLOATS_PER_VERTEX * (summary?.n_vertices ?? 0);
    const given = message.buffer;
    const buffer = given?.byteLength === nBytes ? given : new ArrayBuffer(nBytes);
    const isKnown = fill(owner, message, buffer);
    const isSought = isCompared && message.wantsAll;
    const surfaceM = isSought ? of(owner.compareSurface(reference, fineLevel)) : null;
    const faults = message.wantsAll ? payloadOf<FaultsAnswer>(owner.faults()) : null;
    const costs = payloadOf<GarmentCosts>(owner.costs());
    const solids = payloadOf<SolidsAnswer>(owner.solids());
    const answer: Described = {
      type: 'described',
      request,
      buffer,
      isKnown,
      errorM,
      surfaceM,
      faults,
      costs,
      solids,
    };
    post(answer satisfies FromGarment, [buffer]);
  }

  async function handle(message: ToGarment): Promise<void> {
    if (message.type === 'load') return load(message);
    if (!run || !summary) throw new Error(`${message.type} before load`);
    switch (message.type) {
      case 'advance':
        return advance(run, message);
      case 'reset':
        return reset(run, message);
      case 'describe':
        return describeFrame(run, message);
    }
  }

  return {
    async receive(message) {
      try {
        await handle(message);
      } catch (error) {
        refuse(message.request, internalFailure(describe(error)));
      }
    },
    close() {
      run?.delete();
      run = null;
    },
  };
}
