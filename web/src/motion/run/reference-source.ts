// Brings the reference that the shown cloth is compared with, once somebody wants to compare.

import type { RunNumbers } from '../../shared/bindings/pleat-module';
import { fetchedBytes } from '../../shared/page/fetched';
import type { Store } from '../../shared/state/store';
import { answerOf } from '../../shared/workers/asked';
import { type MotionState, wantsReference } from '../state/motion-state';
import { referenceUrl } from './references';
import type { RunWorker } from './run-worker';

export class ReferenceSource {
  private at: string | null = null; // the reference that the worker has, or is about to get

  constructor(
    private readonly store: Store<MotionState>,
    private readonly worker: Pick<RunWorker, 'ask'>,
    private readonly onNumbers: (numbers: RunNumbers) => void,
  ) {}

  /** Fetches the reference; the cloth goes on without it, and without an error. */
  async bring(): Promise<void> {
    const state = this.store.get();
    const url = referenceUrl(state.setting);
    if (!url || url === this.at || !wantsReference(state)) return;
    this.at = url;
    this.store.set({ reference: 'coming' });
    try {
      const bytes = await fetchedBytes(url);
      if (this.at === url) await this.hand(bytes);
    } catch {
      if (this.at === url) this.fail();
    }
  }

  /** Another worker has none. */
  forget(): void {
    this.at = null;
    this.store.set({ reference: 'unasked' });
  }

  private async hand(bytes: ArrayBuffer): Promise<void> {
    const question = this.worker.ask({ type: 'setReference', bytes }, [bytes]);
    const answer = await answerOf(question, () => this.fail());
    if (answer === null) return;
    this.store.set({ reference: 'here' });
    if (answer.type === 'referenceSet') this.onNumbers(answer.numbers);
  }

  /** The next load tries again, or whoever asks. */
  private fail(): void {
    this.at = null;
    this.store.set({ reference: 'failed' });
  }
}
