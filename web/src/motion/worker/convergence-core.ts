// Compares methods on one step, as a function of the module.
import { granted } from '../../shared/bindings/answers';
import { refusalOf } from '../../shared/bindings/refusals';
import type { Post } from '../../shared/workers/serve';
import type { ConvergenceModule, ConvergenceStudy } from '../bindings/convergence-module';
import type { FromConvergence, ToConvergence } from './convergence-protocol';

/** Less progress is not told. */
const LEAST_PROGRESS = 0.01;

export function studyConvergence(
  module: ConvergenceModule,
  { fabricsText, sceneText, wishText }: ToConvergence,
  post: Post<FromConvergence>,
): void {
  let told = 0;
  function hear(done: number): void {
    if (done < told + LEAST_PROGRESS) return;
    told = done;
    post({ type: 'progress', done }, []);
  }
  try {
    const text = module.studyConvergence(fabricsText, sceneText, wishText, hear);
    const { study } = granted<{ study: ConvergenceStudy }>(text);
    post({ type: 'studied', study }, []);
  } catch (error) {
    post(refusalOf(error), []);
  }
}
