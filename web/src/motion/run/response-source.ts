// Has a worker beside the shown cloth study what the shown scene does after its first contact.
import { Refused } from '../../shared/bindings/answers';
import { fabricsText } from '../../shared/fabric/fabric-data';
import { type Store, watch } from '../../shared/state/store';
import type { MotionState, ResponseStory } from '../state/motion-state';
import { sceneOf } from '../state/setting';
import {
  type MeasuringClient,
  type StartMeasuring,
  startMeasuringWorker,
} from './measuring-client';

/** So long after first contact [s]. */
export const WINDOW_S = 0.05;

/** Settings that follow each other faster than this are not studied [ms]. */
const REST_MS = 300;

const COULD_NOT = 'What happens at contact could not be studied. Try again.';

export class ResponseSource {
  private sceneText: string | null = null; // the scene that was studied last, or is being studied
  private restHandle: ReturnType<typeof setTimeout> | undefined;
  private client: MeasuringClient | null = null;
  readonly close: () => void;

  constructor(
    private readonly store: Store<MotionState>,
    private readonly isWanted: () => boolean,
    private readonly start: StartMeasuring = startMeasuringWorker,
  ) {
    const stop = watch(store, ['setting', 'mesh'], () => this.follow());
    this.close = () => {
      stop();
      this.cancel();
    };
  }

  /** Studies the shown scene if that is wanted and has not been done. */
  follow(): void {
    if (!this.isWanted()) return;
    const { setting, mesh } = this.store.get();
    const { bounces: _, ...asItRests } = setting;
    const sceneText = JSON.stringify(sceneOf(asItRests, mesh));
    if (sceneText === this.sceneText) return;
    this.cancel();
    this.sceneText = sceneText;
    this.store.set({ response: 'coming' });
    this.restHandle = setTimeout(() => void this.study(sceneText), REST_MS);
  }

  private async study(sceneText: string): Promise<void> {
    const client = this.start({});
    this.client = client;
    let response: ResponseStory;
    try {
      const question = {
        type: 'studyResponse',
        fabricsText,
        sceneText,
        windowS: WINDOW_S,
      } as const;
      response = (await client.ask(question)).study;
    } catch (error) {
      response = { refused: error instanceof Refused ? error.failure.what : COULD_NOT };
    }
    if (this.client !== client) return;
    this.client.terminate();
    this.client = null;
    this.store.set({ response });
  }

  /** Gives up what is being studied. */
  private cancel(): void {
    clearTimeout(this.restHandle);
    this.client?.terminate();
    this.client = null;
  }
}
