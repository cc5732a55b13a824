// Has a worker beside the shown cloth compare methods on one step of the shown scene.
import { brokenSentence, type Failure, sentenceOf } from '../../shared/bindings/answers';
import { fabricsText } from '../../shared/fabric/fabric-data';
import { stepTitle } from '../../shared/panels/quantity';
import type { Store } from '../../shared/state/store';
import {
  type ConvergenceState,
  type ConvergenceStory,
  comparedMethods,
  constraintsOf,
  convergenceWish,
} from '../state/convergence';
import type { MotionState } from '../state/motion-state';
import { PRESETS, sceneOf } from '../state/setting';
import {
  type ConvergenceClient,
  type StartConvergence,
  startConvergenceWorker,
} from './measuring-client';

/** What is studied, in words. */
function subject({ setting, mesh, astray }: MotionState, timeS: number, isNow: boolean): string {
  const cloth = mesh && setting.preset === 'obj' ? mesh.name : PRESETS[setting.preset].title;
  const step = `the step of ${stepTitle(setting.stepS)} at ${timeS.toFixed(2)}\u00a0s`;
  const byItself = isNow && astray ? ', as the scene runs by itself' : '';
  return `${cloth}, ${setting.fabric}, level ${setting.level}: ${step}${byItself}.`;
}

/** What helps where a part of the scene is at fault, by its JSON pointer. */
const REMEDIES: Readonly<Record<string, string>> = {
  '/model': ' Springs can be compared: choose them as the model of the cloth.',
  '/model/damping': ' Rigid springs can be compared.',
  '/method': ' An earlier step may do.',
};

function refusal(failure: Failure): string {
  return `This step cannot be studied: ${sentenceOf(failure)}.${REMEDIES[failure.where] ?? ''}`;
}

export class ConvergenceRun {
  private client: ConvergenceClient | null = null;

  constructor(
    private readonly motion: Store<MotionState>,
    private readonly store: Store<ConvergenceState>,
    private readonly startWorker: StartConvergence = startConvergenceWorker,
  ) {}

  start(): void {
    this.client?.terminate();
    this.motion.set({ playing: false }); // a second busy worker would make every time too long
    const state = this.motion.get();
    const { setting, mesh, numbers } = state;
    const { begin } = this.store.get();
    const constraints = this.store.get().constraints ?? constraintsOf(setting);
    const timeS = begin ?? numbers?.time_s ?? 0;
    const methods = comparedMethods(setting, constraints);
    const client = this.startWorker({
      news: (message) => {
        if (message.type === 'progress') return this.store.set({ story: { done: message.done } });
        this.end(
          message.type === 'studied'
            ? { study: message.study, methods, constraints }
            : { refused: refusal(message.failure) },
        );
      },
      broken: (reason) => this.end({ refused: brokenSentence('The comparison', reason) }),
    });
    this.client = client;
    this.store.set({ of: subject(state, timeS, begin === null), story: { done: 0 } });
    client.tell({
      type: 'studyConvergence',
      fabricsText,
      sceneText: JSON.stringify(sceneOf(setting, mesh)),
      wishText: JSON.stringify(convergenceWish(methods, constraints, timeS)),
    });
  }

  cancel(): void {
    this.end('unasked');
  }

  private end(story: ConvergenceStory): void {
    this.client?.terminate();
    this.client = null;
    this.store.set({ story });
  }
}
