// Changes of the keys by a visitor: keep, replace, delete, take from files.
import { inputFailure } from '../../shared/bindings/answers';
import { openObjFile } from '../../shared/state/obj-file';
import type { KeyOrigin, KeyShape } from '../state/key-shapes';
import { MOST_KEYS } from '../state/timeline';
import type { ModesRun } from './modes-run';

export class KeyEditor {
  constructor(private readonly run: ModesRun) {}

  /** The present mix becomes a key behind the chosen one. */
  keep(): void {
    const key = this.presentMix();
    if (key) this.insert([key]);
  }

  /** The present mix takes the place of the chosen key. */
  replace(): void {
    const key = this.presentMix();
    const { keys, chosenKey } = this.run.store.get();
    if (key)
      this.set(
        keys.map((one, index) => (index === chosenKey ? key : one)),
        chosenKey,
      );
  }

  delete(): void {
    const { keys, chosenKey } = this.run.store.get();
    if (keys.length <= 2) return;
    this.set(
      keys.filter((_, index) => index !== chosenKey),
      Math.max(0, chosenKey - 1),
    );
  }

  /** Keys of the same vertices, in the unit of the model. */
  async openFiles(files: readonly File[]): Promise<void> {
    const body = this.run.present;
    if (!body) return;
    const read: KeyShape[] = [];
    for (const file of files) {
      const obj = await openObjFile(file);
      if (typeof obj === 'string') return this.run.refuse(inputFailure(obj));
      const positions = await this.run.keyFrom(obj);
      if (!positions) return;
      read.push({ origin: { kind: 'file', name: file.name }, positions });
    }
    if (body === this.run.present) this.insert(read);
  }

  private presentMix(): KeyShape | null {
    const { energy, amplitudes } = this.run.store.get();
    const origin: KeyOrigin = { kind: 'mix', energy, amplitudes };
    return this.run.present?.key(origin) ?? null;
  }

  private insert(added: readonly KeyShape[]): void {
    const { keys, chosenKey } = this.run.store.get();
    if (keys.length + added.length > MOST_KEYS)
      return this.run.refuse(
        inputFailure(`A timeline has ${MOST_KEYS} keys at most: delete one first.`),
      );
    const at = Math.min(chosenKey + 1, keys.length);
    this.set([...keys.slice(0, at), ...added, ...keys.slice(at)], at);
  }

  private set(keys: readonly KeyShape[], chosenKey: number): void {
    const { store, keyWork, present } = this.run;
    store.set({ keys, chosenKey, time: chosenKey, problem: null });
    if (present) void keyWork.update(present);
  }
}
