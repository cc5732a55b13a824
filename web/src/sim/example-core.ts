// What the worker of the example does with each message: plans in an instant, from what was recorded.
// The only file that calls delete() on its object.
import type { PlanFile } from '../state/plan-file';
import { describe, internalFailure, read } from './answers';
import type { ExamplePost, ToExample } from './garment-protocol';
import { readRecording } from './recording';
import type { ExampleStudyHandle, RefinementModule } from './refinement-module';
import type { Failure } from './wasm-module';

/** Serves one page. Call `receive` with each message, `close` at the end. */
export function createExampleCore(
  module: RefinementModule,
  post: ExamplePost,
  nowMs: () => number,
): { receive(message: ToExample): Promise<void>; close(): void } {
  let study: ExampleStudyHandle | null = null;

  function refuse(request: number, failure: Failure): void {
    post({ type: 'refused', request, failure }, []);
  }

  async function open(message: Extract<ToExample, { type: 'open' }>): Promise<void> {
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

  function plan(owner: ExampleStudyHandle, message: Extract<ToExample, { type: 'plan' }>): void {
    const beginMs = nowMs();
    const answer = read<{ plan: PlanFile }>(owner.plan(JSON.stringify(message.wish)));
    if (!answer.ok) return refuse(message.request, answer);
    const { request } = message;
    post({ type: 'planned', request, plan: answer.plan, ms: nowMs() - beginMs }, []);
  }

  return {
    async receive(message) {
      try {
        if (message.type === 'open') return await open(message);
        if (!study) throw new Error('plan before open');
        plan(study, message);
      } catch (error) {
        const request = message.type === 'plan' ? message.request : 0;
        refuse(request, internalFailure(describe(error)));
      }
    },
    close() {
      study?.delete();
      study = null;
    },
  };
}
