// Where the mesh of "Your OBJ" comes from: the visitor's file, or an example until there is one.
import exampleUrl from '../../../../assets/meshes/skirt.obj?url';
import { sentenceOf } from '../../shared/bindings/answers';
import type { Store } from '../../shared/state/store';
import { answerOf } from '../../shared/workers/asked';
import { AT_START, type MotionState } from '../state/motion-state';
import type { ObjMesh } from '../state/obj-mesh';
import { presetSetting } from '../state/setting';
import type { RunWorker } from './run-worker';

export class ObjSource {
  constructor(
    private readonly store: Store<MotionState>,
    private readonly worker: Pick<RunWorker, 'ask'>,
    private readonly onExample: () => void,
  ) {}

  /** Shows the visitor's mesh, or says what is wrong with the file while the cloth goes on. */
  async open(file: File): Promise<void> {
    const { name } = file;
    if (!/\.obj$/i.test(name))
      return this.refuse(`${name} is no OBJ file: the name does not end in .obj.`);
    const text = await file.text().catch(() => null);
    if (text === null) return this.refuse(`${name} could not be read.`);
    await this.read(name, text, true);
  }

  /** Brings the mesh that stands in until there is one of the visitor's. */
  async bringExample(): Promise<void> {
    try {
      const answer = await fetch(exampleUrl);
      if (!answer.ok) throw new Error(answer.statusText);
      await this.read('skirt.obj', await answer.text(), false);
    } catch {
      if (this.store.get().setting.preset !== 'obj') return;
      const sentence =
        'The example mesh could not be fetched. Check the connection, or bring yours.';
      const problem = { source: 'setting', sentence } as const;
      this.store.set({ phase: 'refused', playing: false, problem });
    }
  }

  private async read(name: string, objText: string, isOwn: boolean): Promise<void> {
    const question = this.worker.ask({ type: 'readObj', name, objText, isOwn });
    const answer = await answerOf(question, (failure) => this.refuse(sentenceOf(failure)));
    if (answer?.type === 'objRead') this.take(answer.mesh);
    if (answer?.type === 'objRefused') this.refuse(sentenceOf(answer.failure));
  }

  private take(mesh: ObjMesh): void {
    const { setting, mesh: present } = this.store.get();
    if (mesh.isOwn) {
      const start = setting.preset === 'obj' ? setting : presetSetting('obj');
      return this.store.set({
        ...AT_START,
        mesh,
        setting: { ...start, level: 0, hold: 'highest' },
      });
    }
    if (present) return; // the visitor was quicker
    this.store.set({ mesh });
    if (setting.preset === 'obj') this.onExample();
  }

  private refuse(sentence: string): void {
    this.store.set({ problem: { source: 'file', sentence } });
  }
}
