// Has a worker beside the shown cloth study what the shown scene does after its first contact.
import { Refused } from '../../shared/bindings/answers';
import { fabricsText } from '../../shared/fabric/fabric-data';
import { type Store, watch } from '../../shared/state/store';
import type { MotionState, ResponseStory } from '../state/motion-state';
import { sceneOf } from '../state/setting';
import { Beside } from './beside';
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

async function studied(client: MeasuringClient, sceneText: string): Promise<ResponseStory> {
  const question = { type: 'studyResponse', fabricsText, sceneText, windowS: WINDOW_S } as const;
  try {
    return (await client.ask(question)).study;
  } catch (error) {
    return { refused: error instanceof Refused ? error.failure.what : COULD_NOT };
  }
}

export class ResponseSource {
  private sceneText: string | null = null; // the scene that was studied last, or is being studied
  private readonly study: Beside;

  constructor(
    private readonly store: Store<MotionState>,
    private readonly isWanted: () => boolean,
    start: StartMeasuring = startMeasuringWorker,
  ) {
    this.study = new Beside(start, REST_MS);
    watch(store, ['setting', 'mesh'], () => this.follow());
  }

  /** Studies the shown scene if that is wanted and has not been done. */
  follow(): void {
    if (!this.isWanted()) return;
    const { setting, mesh } = this.store.get();
    const { bounces: _, ...asItRests } = setting;
    const sceneText = JSON.stringify(sceneOf(asItRests, mesh));
    if (sceneText === this.sceneText) return;
    this.sceneText = sceneText;
    this.store.set({ response: 'coming' });
    this.study.later(
      (client) => studied(client, sceneText),
      (response) => this.store.set({ response }),
    );
  }
}
