// Asks which springs of the loaded cloth are implicit, for as long as that is drawn.
import type { Store } from '../../shared/state/store';
import type { SpringsMessage } from '../../shared/workers/motion-protocol';
import type { MotionState } from '../state/motion-state';

export class SpringSource {
  constructor(
    private readonly store: Store<MotionState>,
    /** The answer; null when it comes too late. */
    private readonly read: () => Promise<SpringsMessage | null>,
  ) {}

  /** The split changes with the mesh, the step, and what is held. */
  async bring(): Promise<void> {
    if (!this.store.get().springs) return;
    const answer = await this.read();
    if (!answer) return;
    const { ends, isImplicit } = answer;
    this.store.set({ springSplit: { ends, isImplicit } });
  }
}
