// One cloth of several in motion: its worker, which has a successor once it has ended, and the buffer in which
// its frames travel.
import type { Collider, Triple } from '../bindings/geometry';
import { fabricsText } from '../fabric/fabric-data';
import type { MotionClient, StartMotion } from './motion-client';
import type { FrameMessage, LoadedMessage } from './motion-protocol';
import { Restarts } from './restarts';

export interface SideStart {
  triangles: Uint32Array;
  buffer: ArrayBuffer;
  nVertices: number;
  colliders: Collider[];
}

export class SideRun {
  private client: MotionClient | null = null;
  private readonly restarts = new Restarts();
  private spare: ArrayBuffer | null = null; // the buffer that is not shown
  private hasEnded = false;

  /** `ended` hears that the worker ended by itself, and how often in a row, as Restarts counts. */
  constructor(
    private readonly launch: StartMotion,
    private readonly ended: (reason: string, nInARow: number) => void,
  ) {}

  /** Starts a worker where there is none. */
  open(): MotionClient {
    if (this.client) return this.client;
    const broken = (reason: string) => {
      this.close();
      this.ended(reason, this.restarts.noteEnd());
    };
    this.client = this.launch({ broken });
    this.client.tell({ type: 'open', fabricsText });
    return this.client;
  }

  async load(sceneText: string): Promise<SideStart> {
    const question = { type: 'load', sceneText, keepMotion: false } as const;
    return this.start(await this.open().ask(question));
  }

  async reset(): Promise<SideStart> {
    return this.start(await this.open().ask({ type: 'reset' }));
  }

  /** The frame after so many steps; null once the run has ended. */
  async step(count: number): Promise<FrameMessage | null> {
    const buffer = this.spare;
    if (this.hasEnded || !buffer) return null;
    this.spare = null;
    const question = { type: 'step', count, wantsNumbers: true, buffer } as const;
    const answer = await this.open().ask(question, [buffer]);
    if (answer.type !== 'frame') return null;
    this.hasEnded = answer.hasEnded;
    return answer;
  }

  /** Takes hold of a vertex. */
  grab(vertex: number): void {
    this.client?.tell({ type: 'grab', vertex });
  }

  moveGrab(target: Triple): void {
    this.client?.tell({ type: 'moveGrab', target });
  }

  releaseGrab(): void {
    this.client?.tell({ type: 'releaseGrab' });
  }

  /** Ends its worker, whatever it is doing. */
  close(): void {
    this.client?.terminate();
    this.client = null;
    this.spare = null;
  }

  /** Takes back a buffer whose frame is not shown any more. */
  giveBack(buffer: ArrayBuffer): void {
    this.spare = buffer;
  }

  /** Notes that the worker did what it was there for: its next end is the first one again. */
  noteWork(): void {
    this.restarts.noteWork();
  }

  private start(loaded: LoadedMessage): SideStart {
    const { triangles, buffers, colliders, summary } = loaded;
    const [buffer, spare] = buffers;
    this.spare = spare;
    this.hasEnded = false;
    this.restarts.noteStart();
    return { triangles, buffer, colliders, nVertices: summary.n_vertices };
  }
}
