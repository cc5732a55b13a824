// Keeps the in-betweens of the keys up to date: one question at a time, the newest keys in the end.
import type { Failure } from '../../shared/bindings/answers';
import type { Store } from '../../shared/state/store';
import { answerOf } from '../../shared/workers/asked';
import { type KeyOrigin, type KeyShape, remade } from '../state/key-shapes';
import type { ModesState } from '../state/modes-state';
import { frameCount } from '../state/timeline';
import type { CompletedMessage } from '../worker/modal-protocol';
import type { Body } from './body';
import type { ModalClient } from './modal-client';
import { volumeWish } from './mode-finder';
import { noticed } from './slow-work';

type Keys = readonly KeyShape[];

function joined(keys: Keys): Float64Array {
  const length = keys[0]?.positions.length ?? 0;
  const all = new Float64Array(length * keys.length);
  keys.forEach(({ positions }, index) => {
    all.set(positions, index * length);
  });
  return all;
}

/** The one key in which two lists differ; null where that is not all. */
function changedKey(from: Keys, to: Keys): number | null {
  if (from.length !== to.length) return null;
  const changed = to.flatMap((key, index) => (key === from[index] ? [] : [index]));
  const [only] = changed;
  return changed.length === 1 && only !== undefined ? only : null;
}

export class KeyWork {
  private done: Keys = []; // keys that the worker has
  private isBusy = false;

  constructor(
    private readonly store: Store<ModesState>,
    private readonly client: ModalClient,
    private readonly refuse: (failure: Failure) => void,
  ) {}

  /** Keys between which the worker has filled in, as far as they can be made again. */
  known(): KeyOrigin[] {
    return remade(this.done);
  }

  /** Another worker or another body: it has no keys. */
  forget(): void {
    this.done = [];
  }

  /** Has the in-betweens follow the state's keys. */
  async update(body: Body): Promise<void> {
    if (this.isBusy) return;
    this.isBusy = true;
    try {
      while (this.store.get().keys !== this.done && this.store.get().keys.length >= 2)
        if (!(await this.fill(body, this.store.get().keys))) return;
    } finally {
      this.isBusy = false;
    }
  }

  private ask(body: Body, keys: Keys): Promise<CompletedMessage> {
    const frames = frameCount(keys.length);
    const index = changedKey(this.done, keys);
    const changed = index === null ? undefined : keys[index];
    if (index !== null && changed) {
      const { positions } = changed;
      return this.client.ask({ type: 'replace', index, positions, frames });
    }
    const wish = volumeWish(this.store.get(), body);
    return this.client.ask({
      type: 'complete',
      keys: joined(keys),
      nKeys: keys.length,
      wish,
      frames,
    });
  }

  /** True when the worker has these keys then. */
  private async fill(body: Body, keys: Keys): Promise<boolean> {
    const { store } = this;
    const { model, surface } = store.get();
    const question = answerOf(this.ask(body, keys), this.refuse);
    const answer = await noticed(store, 'Filling in between the keys', question);
    const isCurrent = store.get().model === model && store.get().surface === surface;
    if (!isCurrent) return false;
    if (!answer) {
      const before = this.done;
      // A refused replacement may have left the worker's key half changed.
      this.forget();
      if (store.get().keys === keys) store.set({ keys: before, chosenKey: 0 });
      return false;
    }
    this.done = keys;
    body.setFilled(answer);
    const { tets, bodies } = answer.answer;
    store.set({ completion: { frames: answer.frames, tets, bodies, shares: answer.shares } });
    return true;
  }
}
