// Where the mesh of "Your OBJ" comes from: the visitor's file, or an example until there is one. A file is
// read in a worker of its own, so that the cloth goes on and the reading can be given up.
import exampleUrl from '../../../../assets/meshes/skirt.obj?url';
import { brokenSentence, sentenceOf } from '../../shared/bindings/answers';
import { fabricsText } from '../../shared/fabric/fabric-data';
import { fetched } from '../../shared/page/fetched';
import {
  type ObjFile,
  type ObjUnit,
  oddSize,
  openObjFile,
  textInMetres,
} from '../../shared/state/obj-file';
import type { Store } from '../../shared/state/store';
import { answerOf } from '../../shared/workers/asked';
import { AT_START, type MotionState } from '../state/motion-state';
import type { ObjMesh } from '../state/obj-mesh';
import { presetSetting } from '../state/setting';
import { type ObjClient, type StartObj, startObjWorker } from './obj-client';

export class ObjSource {
  private client: ObjClient | null = null; // the client that is reading
  private own: ObjFile | null = null; // the visitor's, that was read last

  constructor(
    private readonly store: Store<MotionState>,
    private readonly start: StartObj = startObjWorker,
    private readonly onExample: () => void,
  ) {}

  /** Shows the visitor's mesh, or says what is wrong with the file while the cloth goes on. */
  async open(file: File): Promise<void> {
    this.store.set({ reading: file.name });
    const read = await openObjFile(file);
    if (this.store.get().reading !== file.name) return; // given up
    if (typeof read === 'string') return this.refuse(read);
    await this.read(read, 'm', true);
  }

  /** Takes the visitor's file in another unit. */
  async setUnit(unit: ObjUnit): Promise<void> {
    if (this.own) await this.read(this.own, unit, true);
  }

  /** Gives up what is being read. */
  cancel(): void {
    this.client?.terminate();
    this.client = null;
    this.store.set({ reading: null });
  }

  /** Brings the mesh that stands in until there is one of the visitor's. */
  async bringExample(): Promise<void> {
    try {
      const text = await (await fetched(exampleUrl)).text();
      const read = await openObjFile(new File([text], 'skirt.obj'));
      if (typeof read !== 'string' && this.client === null) await this.read(read, 'm', false);
    } catch {
      if (this.store.get().setting.preset !== 'obj') return;
      const sentence =
        'The example mesh could not be fetched. Check the connection, or bring yours.';
      const problem = { source: 'setting', sentence } as const;
      this.store.set({ phase: 'refused', playing: false, problem });
    }
  }

  private async read(file: ObjFile, unit: ObjUnit, isOwn: boolean): Promise<void> {
    this.cancel();
    const { name, low, high } = file;
    const client = this.start({
      broken: (reason) => this.refuse(brokenSentence('The mesh', reason)),
    });
    this.client = client;
    if (isOwn) this.store.set({ reading: name });
    const question = client.ask({
      type: 'readObj',
      fabricsText,
      objText: textInMetres(file, unit),
      file: { name, isOwn, unit, odd: oddSize(file, unit), low, high },
    });
    const answer = await answerOf(question, (failure) => this.refuse(sentenceOf(failure)));
    if (!answer || this.client !== client) return;
    this.cancel();
    if (isOwn) this.own = file;
    this.take(answer.mesh);
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
    this.cancel();
    this.store.set({ problem: { source: 'file', sentence } });
  }
}
