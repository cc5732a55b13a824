// Answers each question to the worker of modes, as a function of the module and of where answers go. The only
// file that calls delete() on its objects.
import { granted } from '../../shared/bindings/answers';
import { ModuleCore } from '../../shared/workers/serve';
import type {
  CompletionAnswer,
  FilledFrame,
  ModalModule,
  ModalStudyHandle,
  ModesAnswer,
  RunAnswer,
  SurfaceAnswer,
} from '../bindings/modal-module';
import type { FromModal, Opened, ToModal } from './modal-protocol';

/** A draped cloth is let run this long to come to rest [s]. */
const REST_S = 12;

type Question<Type extends ToModal['type']> = Extract<ToModal, { type: Type }>;

function opened(study: ModalStudyHandle, { kind, text }: Opened): SurfaceAnswer {
  const open = { box: study.openBox, obj: study.openObj, scene: study.openScene }[kind];
  return granted<SurfaceAnswer>(open.call(study, text));
}

/** Serves one page. Call `receive` with each message. */
export class ModalCore extends ModuleCore<ModalModule, ToModal, FromModal> {
  private study: ModalStudyHandle | null = null;
  private completion: CompletionAnswer = { tets: 0, bodies: 0 };

  close(): void {
    this.study?.delete();
    this.study = null;
  }

  protected handle(message: ToModal): void {
    if (message.type === 'open') return this.open(message);
    if (!this.study) throw new Error(`${message.type} before open`);
    switch (message.type) {
      case 'modes':
        return this.findModes(this.study, message);
      case 'complete':
        return this.complete(this.study, message);
      case 'replace':
        granted(this.study.replaceKey(message.index, message.positions));
        return this.fillIn(this.study, message.frames);
      case 'key': {
        granted(this.study.readKey(message.text));
        const positions = this.study.key().slice();
        return this.post({ type: 'key', positions }, [positions.buffer]);
      }
      case 'drapeShares': {
        const { shares } = granted<{ shares: number[] }>(
          this.study.clothShares(message.drape, message.count),
        );
        return this.post({ type: 'shares', shares }, []);
      }
    }
  }

  /** Another study takes the place of the present one once it is there. */
  private open({ fabricsText, opened: wanted }: Question<'open'>): void {
    const study = new this.module.ModalStudy(fabricsText);
    try {
      const answer = opened(study, wanted);
      const drape = wanted.kind === 'scene' ? this.drape(study, answer, wanted) : [];
      const frames = new Float64Array(3 * answer.n_vertices * drape.length);
      drape.forEach((frame, index) => {
        frames.set(frame, index * frame.length);
      });
      const triangles = study.triangles().slice();
      const shape = study.shape().slice();
      this.close();
      this.study = study;
      this.post({ type: 'opened', answer, triangles, shape, drape: frames }, [
        triangles.buffer,
        shape.buffer,
        frames.buffer,
      ]);
    } catch (error) {
      if (this.study !== study) study.delete();
      throw error;
    }
  }

  private drape(
    study: ModalStudyHandle,
    answer: SurfaceAnswer,
    { frames, stepsEach }: Extract<Opened, { kind: 'scene' }>,
  ): Float64Array[] {
    const kept: Float64Array[] = [];
    while (kept.length < frames) {
      if (kept.length > 0) granted<RunAnswer>(study.run(stepsEach));
      kept.push(study.shape().slice());
    }
    if (frames > 0) granted<RunAnswer>(study.run(Math.round(REST_S / (answer.step_s ?? 1))));
    return kept;
  }

  private findModes(study: ModalStudyHandle, { energy, wish }: Question<'modes'>): void {
    const answer = granted<ModesAnswer>(study.findModes(JSON.stringify({ energy, ...wish })));
    const moves = study.moves().slice();
    this.post({ type: 'modes', energy, answer, moves }, [moves.buffer]);
  }

  private complete(
    study: ModalStudyHandle,
    { keys, nKeys, wish, frames }: Question<'complete'>,
  ): void {
    const text = JSON.stringify({ keys: nKeys, ...wish });
    this.completion = granted<CompletionAnswer>(study.complete(keys, text));
    this.fillIn(study, frames);
  }

  private fillIn(study: ModalStudyHandle, count: number): void {
    const { frames } = granted<{ frames: FilledFrame[] }>(study.fillIn(count));
    const filled = new Float32Array(study.filled());
    const shares =
      this.completion.bodies === 1
        ? granted<{ shares: number[] }>(study.volumeShares()).shares
        : null;
    this.post({ type: 'completed', answer: this.completion, frames, filled, shares }, [
      filled.buffer,
    ]);
  }
}
