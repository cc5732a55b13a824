// A visitor's hand: bends the body along its softest modes, or leads it along its keys.
import type { Triple } from '../../shared/bindings/geometry';
import type { Store } from '../../shared/state/store';
import type { ModesState } from '../state/modes-state';
import type { ModesRun } from './modes-run';
import { shownEnergies } from './showing';

export class Pull {
  private taken: { vertex: number; pane: number } | null = null;

  constructor(
    private readonly store: Store<ModesState>,
    private readonly run: ModesRun,
    /** True when a body that is let go may swing of itself. */
    private readonly maySwing: () => boolean,
  ) {}

  grab(vertex: number, pane: number): void {
    this.taken = { vertex, pane };
    this.store.set({ playing: false, invited: false });
  }

  /** Moves the taken vertex to this place [m]. */
  move(target: Triple): void {
    const body = this.run.present;
    const { taken, store } = this;
    const state = store.get();
    if (!taken || !body || state.phase !== 'ready') return;
    if (state.showing === 'keys') {
      const time = body.timeNearest(taken.vertex, target);
      if (time !== null) store.set({ time });
      return;
    }
    const energy = shownEnergies(state)[taken.pane] ?? state.energy;
    const modes = this.run.finder.found(energy)?.modes ?? [];
    store.set({ amplitudes: body.pulled(energy, modes, taken.vertex, target) });
  }

  /** A body that was bent swings from there. */
  release(): void {
    this.taken = null;
    const { showing, amplitudes } = this.store.get();
    const isBent = amplitudes.some((amplitude) => amplitude !== 0);
    if (showing === 'modes' && isBent && this.maySwing()) this.store.set({ playing: true });
  }
}
