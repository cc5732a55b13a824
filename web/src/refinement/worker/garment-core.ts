// Answers each message to the worker of one pane, as a function of the module and of where answers
// go. The only file that calls delete() on its object.

import { granted, type RunStatus, read } from '../../shared/bindings/answers';
import { FLOATS_PER_VERTEX, frameViews } from '../../shared/bindings/frame';
import { ModuleCore } from '../../shared/workers/serve';
import type {
  ComparedAnswer,
  FaultsAnswer,
  FitAnswer,
  GarmentCosts,
  GarmentRunHandle,
  GarmentSummary,
  RefinementModule,
  SolidsAnswer,
  WarningsAnswer,
} from '../bindings/refinement-module';
import { type Fit, LastingShare } from '../state/fit';
import type { Described, FromGarment, ToGarment } from './garment-protocol';
import { type Recording, readRecording } from './recording';

type Message<Type> = Extract<ToGarment, { type: Type }>;

/** The payload of an answer that a frame can do without; null when it was refused. */
function payloadOf<Payload>(text: string): Payload | null {
  const answer = read<Payload>(text);
  return answer.ok ? answer : null;
}

/** Folds come and go: fewer frames tell of chance alone. */
const FEWEST_FOLDED_FRAMES = 30;

/** Serves one pane. Call `receive` with each message, `close` at the end. */
export class GarmentCore extends ModuleCore<RefinementModule, ToGarment, FromGarment> {
  private run: GarmentRunHandle | null = null;
  private summary: GarmentSummary | null = null;
  private recording: Recording | null = null;
  private recordedFolds: Float64Array | null = null;
  private nFolded = 0; // computed frames whose folds count
  private nWatched = 0; // frames of the record that the monitor has seen
  private lasting = new LastingShare();
  private settledS = 0;
  private stepsPerFrame = 1;

  private async load(message: Message<'load'>): Promise<void> {
    const { fabricsText, sceneText, fineText, files, frameS, settledS } = message;
    this.run ??= new this.module.GarmentRun(fabricsText);
    const answer = granted<GarmentSummary>(this.run.load(sceneText, files));
    granted(this.run.holdAgainst(fineText, files));
    this.summary = answer;
    this.settledS = settledS;
    this.beginAnew();
    this.stepsPerFrame = Math.max(1, Math.round(frameS / answer.step_s));
    const mesh = {
      triangles: this.run.triangles().slice(),
      triangleFaces: this.run.triangleFaces().slice(),
      edges: this.run.edges().slice(),
      hanging: this.run.hanging().slice(),
      faces: this.run.faces().slice(),
      parents: this.run.parents().slice(),
    };
    this.recording = message.recording
      ? await readRecording(new Uint8Array(message.recording), mesh.parents)
      : null;
    const head = this.recording?.head ?? null;
    this.recordedFolds = this.recording && this.foldsOf(this.run, this.recording);
    this.post({ type: 'loaded', summary: answer, mesh, recording: head }, [
      mesh.triangles.buffer,
      mesh.triangleFaces.buffer,
      mesh.edges.buffer,
      mesh.hanging.buffer,
      mesh.faces.buffer,
      mesh.parents.buffer,
    ]);
  }

  /** The folds of all settled frames of a record. */
  private foldsOf(owner: GarmentRunHandle, { head, frames }: Recording): Float64Array | null {
    frames.forEach((places, frame) => {
      const timeS = head.first_s + frame * head.every_s;
      if (timeS >= this.settledS && read<object>(owner.put(places, timeS)).ok) owner.addFolds();
    });
    const folds = owner.folds().slice();
    return folds.length > 0 ? folds : null;
  }

  private ended(owner: GarmentRunHandle): string {
    const status = payloadOf<RunStatus>(owner.status());
    return status ? `${status.status.replaceAll('_', ' ')}: ${status.message}` : 'no report';
  }

  /** The monitor's word on the shown frame; null without a monitor. */
  private watch(owner: GarmentRunHandle): Fit | null {
    if (!this.summary?.has_monitor) return null;
    const seen = payloadOf<FitAnswer>(owner.addShownFrame());
    return seen && { ...seen, lasting_share: this.lasting.add(seen.share) };
  }

  private put(owner: GarmentRunHandle, frame: number): void {
    const places = this.recording?.frames[frame];
    if (!places || !this.recording) throw new Error(`no frame ${frame}`);
    const { first_s: firstS, every_s: everyS } = this.recording.head;
    granted(owner.put(places, firstS + frame * everyS));
  }

  /** Shows a frame of the record. The monitor sees all up to it, whatever the display left out. */
  private show(owner: GarmentRunHandle, frame: number): Fit | null {
    let fit: Fit | null = null;
    if (this.summary?.has_monitor) {
      if (frame < this.nWatched) this.reset(owner);
      for (; this.nWatched <= frame; ++this.nWatched) {
        this.put(owner, this.nWatched);
        fit = this.watch(owner);
      }
    } else this.put(owner, frame);
    return fit;
  }

  private step(owner: GarmentRunHandle): string | null {
    if (owner.step(this.stepsPerFrame) !== 0) return this.ended(owner);
    if (owner.time() >= this.settledS && read<object>(owner.addFolds()).ok) this.nFolded += 1;
    return null;
  }

  private advance(owner: GarmentRunHandle, { frame, how }: Message<'advance'>): void {
    const ended = how === 'stepped' ? this.step(owner) : null;
    const fit =
      how === 'recorded' ? this.show(owner, frame) : how === 'stepped' ? this.watch(owner) : null;
    this.post({ type: 'advanced', fit, ended }, []);
  }

  private beginAnew(): void {
    this.nFolded = 0;
    this.nWatched = 0;
    this.lasting = new LastingShare();
  }

  private reset(owner: GarmentRunHandle): void {
    granted(owner.reset());
    this.beginAnew();
  }

  private fill(
    owner: GarmentRunHandle,
    { scalar }: Message<'describe'>,
    buffer: ArrayBuffer,
  ): void {
    const views = frameViews(buffer);
    views.positions.set(owner.positions());
    const values =
      scalar === 'curvature' ? owner.curvature() : scalar === 'distance' ? owner.distances() : null;
    if (values?.length === views.scalar.length) views.scalar.set(values);
    else views.scalar.fill(Number.NaN);
  }

  private folds(owner: GarmentRunHandle): Float64Array | null {
    if (this.recording) return this.recordedFolds;
    return this.nFolded < FEWEST_FOLDED_FRAMES ? null : owner.folds().slice();
  }

  private foldsFrom(owner: GarmentRunHandle, message: Message<'describe'>): number | null {
    const { fineFolds } = message;
    const folds = this.folds(owner);
    if (!folds || !fineFolds) return null;
    const answer = owner.compareFolds(folds, fineFolds);
    return payloadOf<{ distance_m: number }>(answer)?.distance_m ?? null;
  }

  private describeFrame(owner: GarmentRunHandle, message: Message<'describe'>): void {
    const { reference, timeS } = message;
    const own = message.takesSample ? owner.positions().slice() : null;
    if (own && reference) granted(owner.putSample(reference, timeS));
    const compared = reference && payloadOf<ComparedAnswer>(owner.compare(reference));
    const nBytes = 4 * FLOATS_PER_VERTEX * (this.summary?.n_vertices ?? 0);
    const given = message.buffer;
    const buffer = given?.byteLength === nBytes ? given : new ArrayBuffer(nBytes);
    this.fill(owner, message, buffer);
    const isSought = reference !== null && message.wantsSurface && !message.takesSample;
    const surface = isSought ? payloadOf<{ rms_m: number }>(owner.compareSurface(reference)) : null;
    const faults = message.wantsFaults ? payloadOf<FaultsAnswer>(owner.faults()) : null;
    const costs = payloadOf<GarmentCosts>(owner.costs());
    const warnings = payloadOf<WarningsAnswer>(owner.warnings())?.warnings ?? [];
    const solids = payloadOf<SolidsAnswer>(owner.solids());
    if (own) owner.put(own, timeS);
    const answer: Described = {
      type: 'described',
      buffer,
      compared,
      surfaceM: surface?.rms_m ?? null,
      folds: this.folds(owner),
      foldsM: this.foldsFrom(owner, message),
      faults,
      costs,
      warnings,
      solids,
    };
    this.post(answer satisfies FromGarment, [buffer]);
  }

  protected async handle(message: ToGarment): Promise<void> {
    if (message.type === 'load') return this.load(message);
    if (!this.run || !this.summary) throw new Error(`${message.type} before load`);
    switch (message.type) {
      case 'advance':
        return this.advance(this.run, message);
      case 'reset':
        return this.reset(this.run);
      case 'describe':
        return this.describeFrame(this.run, message);
    }
  }

  close(): void {
    this.run?.delete();
    this.run = null;
  }
}
