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
import { MODEL_TRAITS, modelsOf, PRESETS, type Setting, sceneOf } from '../state/setting';
import {
  type ConvergenceClient,
  type StartConvergence,
  startConvergenceWorker,
} from './measuring-client';

/** Words on what is studied. */
function subject({ setting, mesh, astray }: MotionState, timeS: number, isNow: boolean): string {
  const cloth = mesh && setting.preset === 'obj' ? mesh.name : PRESETS[setting.preset].title;
  const step = `the step of ${stepTitle(setting.stepS)} at ${timeS.toFixed(2)}\u00a0s`;
  const byItself = isNow && astray ? ', as the scene runs by itself' : '';
  return `${cloth}, ${setting.fabric}, level ${setting.level}: ${step}${byItself}.`;
}

/** Words on what helps where that part of the scene is at fault; its JSON pointer. */
function remedy(where: string, { preset }: Setting): string {
  if (where === '/model/damping') return ' Rigid springs can be compared.';
  if (where === '/method') return ' An earlier step may do.';
  if (where !== '/model') return '';
  return modelsOf(preset).includes('springs')
    ? ' Springs can be compared: choose them as the model of the cloth.'
    : ` ${MODEL_TRAITS.springs.need}`;
}

function refusal(failure: Failure, setting: Setting): string {
  return `This step cannot be studied: ${sentenceOf(failure)}.${remedy(failure.where, setting)}`;
}

export class ConvergenceRun {
  private client: ConvergenceClient | null = null;
  private isWanted = false;
  private stopWatching: () => void = () => undefined;

  constructor(
    private readonly motion: Store<MotionState>,
    private readonly store: Store<ConvergenceState>,
    private readonly rest: () => Promise<void>,
    private readonly startWorker: StartConvergence = startConvergenceWorker,
  ) {}

  /** The cloth rests meanwhile: a second busy worker would make every time too long. */
  async start(): Promise<void> {
    this.isWanted = true;
    this.store.set({ of: '', story: { done: 0 } });
    await this.rest();
    if (!this.isWanted || this.client) return;
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
            : { refused: refusal(message.failure, setting) },
        );
      },
      broken: (reason) => this.end({ refused: brokenSentence('The comparison', reason) }),
    });
    this.client = client;
    this.stopWatching = this.motion.subscribe(({ playing }) => {
      if (playing) this.store.set({ disturbed: true });
    });
    this.store.set({ of: subject(state, timeS, begin === null), disturbed: false });
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
    this.isWanted = false;
    this.stopWatching();
    this.client?.terminate();
    this.client = null;
    this.store.set({ story });
  }
}
