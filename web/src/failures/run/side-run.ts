// One side of a case: its worker, and the buffer in which its frames travel.
import type { Collider, Triple } from '../../shared/bindings/geometry';
import type { StartMotion } from '../../shared/workers/motion-client';
import type {
  FrameMessage,
  LoadedMessage,
  MotionAnswers,
  ToMotion,
} from '../../shared/workers/motion-protocol';
import { Renewed, type RenewedEvents } from '../../shared/workers/renewed';

export interface SideStart {
  triangles: Uint32Array;
  buffer: ArrayBuffer;
  nVertices: number;
  colliders: Collider[];
}

export class SideRun {
  private readonly client: Renewed<ToMotion, MotionAnswers>;
  private spare: ArrayBuffer | null = null; // the buffer that is not shown
  private hasEnded = false;

  constructor(
    start: StartMotion,
    private readonly fabricsText: string,
    events: RenewedEvents,
  ) {
    this.client = new Renewed<ToMotion, MotionAnswers>(start, {
      ...events,
      renewed: (reason) => {
        this.open();
        events.renewed(reason);
      },
    });
    this.open();
  }

  async load(sceneText: string): Promise<SideStart> {
    const question = { type: 'load', sceneText, keepMotion: false } as const;
    return this.begin(await this.client.ask(question));
  }

  async reset(): Promise<SideStart> {
    return this.begin(await this.client.ask({ type: 'reset' }));
  }

  /** The frame after so many steps; null once the run has ended. */
  async step(count: number): Promise<FrameMessage | null> {
    const buffer = this.spare;
    if (this.hasEnded || !buffer) return null;
    this.spare = null;
    const answer = await this.client.ask({ type: 'step', count, wantsNumbers: true, buffer }, [
      buffer,
    ]);
    if (answer.type !== 'frame') return null;
    this.hasEnded = answer.hasEnded;
    return answer;
  }

  /** Takes back a buffer whose frame is not shown any more. */
  giveBack(buffer: ArrayBuffer): void {
    this.spare = buffer;
  }

  grab(vertex: number): void {
    this.client.tell({ type: 'grab', vertex });
  }

  moveGrab(target: Triple): void {
    this.client.tell({ type: 'moveGrab', target });
  }

  releaseGrab(): void {
    this.client.tell({ type: 'releaseGrab' });
  }

  /** Another worker, which has nothing loaded. */
  replace(): void {
    this.client.replace();
    this.open();
  }

  private open(): void {
    this.client.tell({ type: 'open', fabricsText: this.fabricsText });
  }

  private begin({ triangles, buffers, colliders, summary }: LoadedMessage): SideStart {
    const [buffer, spare] = buffers;
    this.spare = spare;
    this.hasEnded = false;
    this.client.prove();
    return { triangles, buffer, colliders, nVertices: summary.n_vertices };
  }
}
