// Answers each message to the worker of the examples: plans in an instant, from what was recorded
// and from what it ran itself. The only file that calls delete() on its objects.

import {
  granted,
  inputFailure,
  Refused,
  type RunStatus,
  read,
} from '../../shared/bindings/answers';
import { ModuleCore } from '../../shared/workers/serve';
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
export class ExampleCore extends ModuleCore<RefinementModule, ToExample, FromExample> {
  private study: ExampleStudyHandle | null = null;
  private running: Running | null = null;

  private async open(message: Message<'open'>): Promise<void> {
    this.study ??= new this.module.ExampleStudy(message.fabricsText);
    granted(this.study.open(message.sceneText, message.files));
    const parents = this.study.parents().slice();
    const features = await readRecording(new Uint8Array(message.features), parents);
    const frames = await readRecording(new Uint8Array(message.frames), parents);
    if (!features?.frames[0] || !frames)
      throw new Error('the example is a record of another cloth');
    for (const frame of frames.frames) this.study.addFrame(frame);
    granted(this.study.sort(message.name, features.frames[0], message.nPatterns));
  }

  private plan(owner: ExampleStudyHandle, message: Message<'plan'>): void {
    const { plan } = granted<{ plan: PlanFile }>(owner.plan(JSON.stringify(message.wish)));
    this.post({ type: 'planned', plan }, []);
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
    const loaded = granted<GarmentSummary>(run.load(sceneText, files));
    granted(seen.open(sceneText, files));
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
      throw new Refused(inputFailure(what));
    }
    now.frame += 1;
    if (now.frame > first) {
      const places = run.positions().slice();
      seen.addFrame(places);
      if ((now.frame - first - 1) % wish.keptOf === 0) owner.addFrame(places);
    }
    if (now.frame === last) {
      const sorted = owner.sort(wish.name, seen.features().slice(), wish.nPatterns);
      this.endRun();
      granted(sorted);
    }
    this.post({ type: 'wentOn', share: now.frame / last }, []);
  }

  protected async handle(message: ToExample): Promise<void> {
    if (message.type === 'open') return this.open(message);
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

  close(): void {
    this.endRun();
    this.study?.delete();
    this.study = null;
  }
}
