// One cloth of several in motion: its worker, and the buffer in which its frames travel.
import type { Collider, Triple } from '../bindings/geometry';
import type { MotionClient } from './motion-client';
import type { FrameMessage, LoadedMessage } from './motion-protocol';

export interface SideStart {
  triangles: Uint32Array;
  /** Two vertices a spring, of cloth that is no surface; else empty. */
  springEnds: Uint32Array;
  buffer: ArrayBuffer;
  nVertices: number;
  colliders: Collider[];
}

export class SideRun {
  private spare: ArrayBuffer | null = null; // the buffer that is not shown
  private hasEnded = false;

  constructor(
    private readonly client: MotionClient,
    fabricsText: string,
  ) {
    client.tell({ type: 'open', fabricsText });
  }

  async load(sceneText: string): Promise<SideStart> {
    const question = { type: 'load', sceneText, keepMotion: false } as const;
    return this.start(await this.client.ask(question));
  }

  async reset(): Promise<SideStart> {
    return this.start(await this.client.ask({ type: 'reset' }));
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

  /** Takes hold of a vertex. */
  grab(vertex: number): void {
    this.client.tell({ type: 'grab', vertex });
  }

  moveGrab(target: Triple): void {
    this.client.tell({ type: 'moveGrab', target });
  }

  releaseGrab(): void {
    this.client.tell({ type: 'releaseGrab' });
  }

  /** Ends its worker, whatever it is doing. */
  close(): void {
    this.client.terminate();
  }

  /** Takes back a buffer whose frame is not shown any more. */
  giveBack(buffer: ArrayBuffer): void {
    this.spare = buffer;
  }

  private async start(loaded: LoadedMessage): Promise<SideStart> {
    const { triangles, buffers, colliders, summary } = loaded;
    const [buffer, spare] = buffers;
    this.spare = spare;
    this.hasEnded = false;
    const springEnds =
      triangles.length > 0
        ? new Uint32Array(0)
        : (await this.client.ask({ type: 'readSprings' })).ends;
    return { triangles, springEnds, buffer, colliders, nVertices: summary.n_vertices };
  }
}
