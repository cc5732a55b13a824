// Time that passes: modes that swing at a visible rate, and the way along the keys and back.
import { createClock } from '../../shared/state/clock';
import type { Store } from '../../shared/state/store';
import type { ModeNumbers } from '../state/material';
import type { ModesState } from '../state/modes-state';

/** Swings a second of the slowest mode that is mixed in. */
const SLOWEST_HZ = 0.5;
/** Swings a second that can still be seen. */
const FASTEST_HZ = 4;
/** Time from one key to the next [s]. */
const KEY_S = 1.5;
/** A tab that was hidden goes on from where it was [s]. */
const LONGEST_STEP_S = 0.1;

/** Amplitudes of modes after so many seconds, as their frequencies stand to each other. */
export function swung(
  amplitudes: readonly number[],
  modes: readonly ModeNumbers[],
  seconds: number,
): number[] {
  const mixed = amplitudes.flatMap((amplitude, mode) =>
    amplitude === 0 ? [] : (modes[mode]?.relative ?? 1),
  );
  const slowest = Math.min(...mixed);
  return amplitudes.map((amplitude, mode) => {
    const relative = slowest > 0 ? (modes[mode]?.relative ?? 1) / slowest : 1;
    const hz = Math.min(FASTEST_HZ, SLOWEST_HZ * relative);
    return amplitude * Math.cos(2 * Math.PI * hz * seconds);
  });
}

/** There and back again: where a way of `length` leads to after `way`. */
export function thereAndBack(way: number, length: number): number {
  const within = way % (2 * length);
  return within <= length ? within : 2 * length - within;
}

export class Swing {
  /** Time since the modes were set to swing [s]. */
  seconds = 0;
  private way = 0; // way covered along the keys and back
  private readonly clock = createClock();

  constructor(
    private readonly store: Store<ModesState>,
    private readonly show: () => void,
  ) {
    store.subscribe((state, previous) => {
      if (state.playing && !previous.playing) this.begin();
      if (state.amplitudes !== previous.amplitudes || !state.playing) this.seconds = 0;
    });
  }

  private begin(): void {
    this.way = this.store.get().time;
    this.clock.start(() => this.tick());
  }

  private tick(): boolean {
    const { playing, showing, speed, keys, completion } = this.store.get();
    const step = speed * Math.min(LONGEST_STEP_S, this.clock.tick(speed));
    if (!playing) return false;
    if (showing === 'modes') {
      this.seconds += step;
      this.show();
    } else if (completion && keys.length >= 2) {
      this.way += step / KEY_S;
      this.store.set({ time: thereAndBack(this.way, keys.length - 1) });
    }
    return true;
  }
}
