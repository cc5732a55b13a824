// What the worker of the examples does with each message: plans in an instant, from what was recorded
// and from what it ran itself. The only file that calls delete() on its objects.
import {
  describe,
  type Failure,
  inputFailure,
  internalFailure,
  type RunStatus,
  read,
} from '../../shared/bindings/answers';
import type {
  ExampleStudyHandle,
  GarmentRunHandle,
  GarmentSummary,
  RefinementModule,
} from '../bindings/refinement-module';
import type { PlanFile } from '../state/plan-file';
import type { ExamplePost, ToExample } from './garment-protocol';
import { readRecording } from './recording';

type Message<Type> = Extract<ToExample, { type: Type }>;

/** An example on its way. */
interface Running {
  wish: Message<'begin'>;
  run: GarmentRunHandle;
  /** Of its frames alone. */
  seen: ExampleStudyHandle;
  stepsPerFrame: number;
  frame: number;
}

/** Serves one page. Call `receive` with each message, `close` at the end. */
export function createExampleCore(
  module: RefinementModule,
  post: ExamplePost,
  nowMs: () => number,
): { receive(message: ToExample): Promise<void>; close(): void } {
  let study: ExampleStudyHandle | null = null;
  let running: Running | null = null;

  function refuse(request: number, failure: Failure): void {
    post({ type: 'refused', request, failure }, []);
  }

  async function open(message: Message<'open'>): Promise<void> {
    study ??= new module.ExampleStudy(message.fabricsText);
    const answer = read<{ n_base_vertices: number; n_vertices: number }>(
      study.open(message.sceneText, message.files),
    );
    if (!answer.ok) return refuse(0, answer);
    const parents = study.parents().slice();
    const features = await readRecording(new Uint8Array(message.features), parents);
    const frames = await readRecording(new Uint8Array(message.frames), parents);
    if (!features?.frames[0] || !frames)
      return refuse(0, internalFailure('the example is a record of another cloth'));
    for (const frame of frames.frames) study.addFrame(frame);
    const sorted = read<object>(study.sort(message.name, features.frames[0], message.nPatterns));
    if (!sorted.ok) return refuse(0, sorted);
    const { n_vertices: nFineVertices, n_base_vertices: nBaseVertices } = answer;
    post({ type: 'opened', nFineVertices, nBaseVertices }, []);
  }

  function plan(owner: ExampleStudyHandle, message: Message<'plan'>): void {
    const beginMs = nowMs();
    const answer = read<{ plan: PlanFile }>(owner.plan(JSON.stringify(message.wish)));
    if (!answer.ok) return refuse(message.request, answer);
    const { request } = message;
    post({ type: 'planned', request, plan: answer.plan, ms: nowMs() - beginMs }, []);
  }

  function endRun(): void {
    running?.run.delete();
    running?.seen.delete();
    running = null;
  }

  function begin(wish: Message<'begin'>): void {
    endRun();
    const { request, fabricsText, sceneText, files } = wish;
    const run = new module.GarmentRun(fabricsText);
    const seen = new module.ExampleStudy(fabricsText);
    running = { wish, run, seen, stepsPerFrame: 1, frame: 0 };
    const loaded = read<GarmentSummary>(run.load(sceneText, files));
    if (!loaded.ok) return refuse(request, loaded);
    const opened = read<object>(seen.open(sceneText, files));
    if (!opened.ok) return refuse(request, opened);
    running.stepsPerFrame = Math.max(1, Math.round(wish.frameS / loaded.step_s));
    post({ type: 'wentOn', request, share: 0 }, []);
  }

  function goOn(owner: ExampleStudyHandle, now: Running, request: number): void {
    const { wish, run, seen } = now;
    const first = Math.round(wish.fromS / wish.frameS);
    const last = Math.round(wish.toS / wish.frameS);
    if (run.step(now.stepsPerFrame) !== 0) {
      const status = read<RunStatus>(run.status());
      const why = status.ok ? `${status.status.replaceAll('_', ' ')}: ${status.message}` : '';
      const what = `The example "${wish.name}" stopped at ${run.time().toFixed(2)} s. ${why}`;
      return refuse(request, inputFailure(what));
    }
    now.frame += 1;
    if (now.frame > first) {
      const places = run.positions().slice();
      seen.addFrame(places);
      if ((now.frame - first - 1) % wish.keptOf === 0) owner.addFrame(places);
    }
    if (now.frame === last) {
      const sorted = read<object>(owner.sort(wish.name, seen.features().slice(), wish.nPatterns));
      endRun();
      if (!sorted.ok) return refuse(request, sorted);
    }
    post({ type: 'wentOn', request, share: now.frame / last }, []);
  }

  function handle(message: Exclude<ToExample, { type: 'open' }>): void {
    if (!study) throw new Error(`${message.type} before open`);
    switch (message.type) {
      case 'begin':
        return begin(message);
      case 'goOn':
        if (!running) throw new Error('goOn before begin');
        return goOn(study, running, message.request);
      case 'plan':
        return plan(study, message);
    }
  }

  return {
    async receive(message) {
      try {
        if (message.type === 'open') return await open(message);
        handle(message);
      } catch (error) {
        const request = message.type === 'open' ? 0 : message.request;
        refuse(request, internalFailure(describe(error)));
      }
    },
    close() {
      endRun();
      study?.delete();
      study = null;
    },
  };
}
