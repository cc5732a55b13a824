// One pane of a garment: its worker, what that has loaded, and the buffers of its frames.
import { describe } from '../../shared/bindings/answers';
import { fabricsText } from '../../shared/fabric/fabric-data';
import { Latest } from '../../shared/state/latest';
import type { GarmentCosts } from '../bindings/refinement-module';
import { FRAME_S, SETTLED_S } from '../state/garment-frames';
import type { GarmentId } from '../state/garments';
import type { FrameSource, PaneId } from '../state/refinement-state';
import type { Advance, Described, ToGarment } from '../worker/garment-protocol';
import type { RecordingHead } from '../worker/recording';
import type { GarmentClient } from './garment-client';
import { type FetchBytes, sceneFiles } from './scene-files';

type Wish = Omit<Extract<ToGarment, { type: 'describe' }>, 'type' | 'buffer'>;

export interface GarmentContent {
  garment: GarmentId;
  sceneText: string;
  /** The scene on the fine mesh. */
  fineText: string;
  /** It has a start of its own. */
  isEven: boolean;
  /** Address of a record of that scene; null for none. */
  recordUrl: string | null;
}

export function createPaneRun(id: PaneId, client: GarmentClient, fetchBytes: FetchBytes) {
  const loads = new Latest();
  let loadedContent = '';
  let recording: RecordingHead | null = null;
  let missed: string | null = null;
  let stepS = FRAME_S;
  let shown: ArrayBuffer | null = null;
  let spare: ArrayBuffer | null = null;

  return {
    id,
    source: 'resting' as FrameSource,
    /** Head of the record that is loaded. */
    recording: () => recording,
    /** Why the record of what is loaded could not be had; null if it could, or if there is none. */
    missed: () => missed,
    isLoaded: () => loadedContent !== '',
    /** Null when that is loaded already. */
    async load({ garment, sceneText, fineText, isEven, recordUrl }: GarmentContent) {
      const content = `${recordUrl} ${sceneText}`;
      const isCurrent = loads.start();
      if (loadedContent === content) return null;
      loadedContent = '';
      let reason: string | null = null;
      const bytes = recordUrl
        ? await fetchBytes(recordUrl).catch((error) => {
            reason = describe(error);
            return null;
          })
        : null;
      const files = await sceneFiles(garment, fetchBytes, isEven);
      const answer = await client.ask(
        {
          type: 'load',
          fabricsText,
          sceneText,
          fineText,
          files,
          recording: bytes,
          frameS: FRAME_S,
          settledS: SETTLED_S,
        },
        bytes ? [bytes] : [],
      );
      if (!isCurrent()) return null; // another one follows
      loadedContent = content;
      recording = answer.recording;
      missed = bytes && !recording ? 'they are of another mesh' : reason;
      stepS = answer.summary.step_s;
      shown = null;
      spare = null;
      return answer;
    },
    async reset() {
      await client.ask({ type: 'reset' });
    },
    advance: (frame: number, how: Advance) => client.ask({ type: 'advance', frame, how }),
    describe(wish: Wish) {
      const buffer = spare;
      spare = null;
      return client.ask({ type: 'describe', ...wish, buffer }, buffer ? [buffer] : []);
    },
    /** Draws this frame from now on; the one before may be overwritten. */
    keep({ buffer }: Described) {
      spare = shown;
      shown = buffer;
    },
    /** Ends its worker. */
    end: () => client.terminate(),
    /** Cost of the frames computed here [ms]. */
    costs({ steps_timed: nSteps, steps_ms: ms, parts_ms: partsMs }: GarmentCosts) {
      if (nSteps === 0) return { msPerFrame: null, parts: [] };
      const perFrame = Math.max(1, Math.round(FRAME_S / stepS)) / nSteps;
      const parts = Object.entries(partsMs).map(([name, part]) => ({ name, ms: part * perFrame }));
      return { msPerFrame: ms * perFrame, parts };
    },
  };
}

export type PaneRun = ReturnType<typeof createPaneRun>;
