// Answers each message to the worker of the examples: plans in an instant, from what was recorded
// and from what it ran itself. The only file that calls delete() on its objects.

import {
  describe,
  type Failure,
  inputFailure,
  internalFailure,
  type RunStatus,
  read,
} from '../../shared/bindings/answers';
import type { Post } from '../../shared/workers/serve';
import type {
  ExampleStudyHandle,
  GarmentRunHandle,
  GarmentSummary,
  RefinementModule,
} from '../bindings/refinement-module';
import type { PlanFile } from '../state/plan-file';
import type { FromExample, ToExample } from './garment-protocol';
import { readRecording } from './recording';

type Message<Type> = Extract<ToExample, { type: Type }>;

/** An example on its way. */
interface Running {
  wish: Message<'begin'>;
  run: GarmentRunHandle;
  /** A study of this example's frames alone. */
  seen: ExampleStudyHandle;
  stepsPerFrame: number;
  frame: number;
}

/** Serves one page. Call `receive` with each message, `close` at the end. */
export class ExampleCore {
  private study: ExampleStudyHandle | null = null;
  private running: Running | null = null;

  private refuse(failure: Failure): void {
    this.post({ type: 'refused', failure }, []);
  }

  private async open(message: Message<'open'>): Promise<void> {
    this.study ??= new this.module.ExampleStudy(message.fabricsText);
    const answer = read<{ n_base_vertices: number; n_vertices: number }>(
      this.study.open(message.sceneText, message.files),
    );
    if (!answer.ok) return this.refuse(answer);
    const parents = this.study.parents().slice();
    const features = await readRecording(new Uint8Array(message.features), parents);
    const frames = await readRecording(new Uint8Array(message.frames), parents);
    if (!features?.frames[0] || !frames)
      return this.refuse(internalFailure('the example is a record of another cloth'));
    for (const frame of frames.frames) this.study.addFrame(frame);
    const sorted = read<object>(
      this.study.sort(message.name, features.frames[0], message.nPatterns),
    );
    if (!sorted.ok) return this.refuse(sorted);
    const { n_vertices: nFineVertices, n_base_vertices: nBaseVertices } = answer;
    this.post({ type: 'opened', nFineVertices, nBaseVertices }, []);
  }

  private plan(owner: ExampleStudyHandle, message: Message<'plan'>): void {
    const beginMs = this.nowMs();
    const answer = read<{ plan: PlanFile }>(owner.plan(JSON.stringify(message.wish)));
    if (!answer.ok) return this.refuse(answer);
    this.post({ type: 'planned', plan: answer.plan, ms: this.nowMs() - beginMs }, []);
  }

  private endRun(): void {
    this.running?.run.delete();
    this.running?.seen.delete();
    this.running = null;
  }

  private begin(wish: Message<'begin'>): void {
    this.endRun();
    const { fabricsText, sceneText, files } = wish;
    const run = new this.module.GarmentRun(fabricsText);
    const seen = new this.module.ExampleStudy(fabricsText);
    this.running = { wish, run, seen, stepsPerFrame: 1, frame: 0 };
    const loaded = read<GarmentSummary>(run.load(sceneText, files));
    if (!loaded.ok) return this.refuse(loaded);
    const opened = read<object>(seen.open(sceneText, files));
    if (!opened.ok) return this.refuse(opened);
    this.running.stepsPerFrame = Math.max(1, Math.round(wish.frameS / loaded.step_s));
    this.post({ type: 'wentOn', share: 0 }, []);
  }

  private goOn(owner: ExampleStudyHandle, now: Running): void {
    const { wish, run, seen } = now;
    const first = Math.round(wish.fromS / wish.frameS);
    const last = Math.round(wish.toS / wish.frameS);
    if (run.step(now.stepsPerFrame) !== 0) {
      const status = read<RunStatus>(run.status());
      const why = status.ok ? `${status.status.replaceAll('_', ' ')}: ${status.message}` : '';
      const what = `The example "${wish.name}" stopped at ${run.time().toFixed(2)} s. ${why}`;
      return this.refuse(inputFailure(what));
    }
    now.frame += 1;
    if (now.frame > first) {
      const places = run.positions().slice();
      seen.addFrame(places);
      if ((now.frame - first - 1) % wish.keptOf === 0) owner.addFrame(places);
    }
    if (now.frame === last) {
      const sorted = read<object>(owner.sort(wish.name, seen.features().slice(), wish.nPatterns));
      this.endRun();
      if (!sorted.ok) return this.refuse(sorted);
    }
    this.post({ type: 'wentOn', share: now.frame / last }, []);
  }

  private handle(message: Exclude<ToExample, { type: 'open' }>): void {
    if (!this.study) throw new Error(`${message.type} before open`);
    switch (message.type) {
      case 'begin':
        return this.begin(message);
      case 'goOn':
        if (!this.running) throw new Error('goOn before begin');
        return this.goOn(this.study, this.running);
      case 'plan':
        return this.plan(this.study, message);
    }
  }

  constructor(
    private readonly module: RefinementModule,
    private readonly post: Post<FromExample>,
    private readonly nowMs: () => number,
  ) {}

  async receive(message: ToExample): Promise<void> {
    try {
      if (message.type === 'open') return await this.open(message);
      this.handle(message);
    } catch (error) {
      this.refuse(internalFailure(describe(error)));
    }
  }

  close(): void {
    this.endRun();
    this.study?.delete();
    this.study = null;
  }
}
