// Plays one scene in two fabrics, in step, with one hand on both.
import { inputFailure } from '../../shared/bindings/answers';
import type { Triple } from '../../shared/bindings/geometry';
import { warningSentence } from '../../shared/panels/warning-words';
import type { Store } from '../../shared/state/store';
import { placeOf } from '../../shared/state/vectors';
import {
  InStep,
  type InStepParts,
  type InStepView,
  type Piece,
} from '../../shared/workers/in-step';
import type { FrameMessage } from '../../shared/workers/motion-protocol';
import { PAIR_STEP_S, type PairState, sceneTextOf } from '../state/pair';

const PANES = [0, 1] as const;

const WORDS = {
  again: 'It was started again, and the cloth is back at its start.',
  twice: 'That happened twice: reset to try once more, or choose something else.',
};

export interface PairView extends InStepView {
  /** All stand at their start; `isNew`: other cloth, to be framed anew. */
  begin(isNew: boolean): void;
  /** The present places of a cloth, three numbers a vertex [m]. */
  positions(pane: number): ArrayLike<number>;
}

/** Largest distance between places with the same number [m]. */
export function farthestApart(a: ArrayLike<number>, b: ArrayLike<number>): number {
  let most = 0;
  for (let k = 0; k + 2 < Math.min(a.length, b.length); k += 3) {
    const [x, y, z] = [0, 1, 2].map((axis) => (a[k + axis] ?? 0) - (b[k + axis] ?? 0));
    most = Math.max(most, Math.hypot(x ?? 0, y ?? 0, z ?? 0));
  }
  return most;
}

export class PairRun {
  private readonly both: InStep;
  private taken: { from: Triple; places: Triple[] } | null = null;

  constructor(
    private readonly store: Store<PairState>,
    private readonly view: PairView,
    parts?: InStepParts,
  ) {
    const piece: Piece = {
      sceneTexts: () => {
        const { scene, pair } = store.get();
        return pair.map((fabric) => sceneTextOf(scene, fabric));
      },
      stepS: PAIR_STEP_S,
      endS: () => Number.POSITIVE_INFINITY,
      words: WORDS,
      lostPhase: 'stopped',
      begun: (_, isNew) => {
        this.taken = null;
        this.measure();
        view.begin(isNew);
      },
      stepped: (frames) => {
        this.measure();
        this.tell(frames);
      },
    };
    this.both = new InStep(store, view, piece, parts);
    store.subscribe((state, previous) => {
      if (state.pair === previous.pair && state.scene === previous.scene) return;
      store.set({ problem: null });
      this.both.open();
    });
    this.both.open();
  }

  play(): void {
    this.store.set({ invited: false });
    this.both.play();
  }

  pause(): void {
    this.both.pause();
  }

  step(): void {
    this.store.set({ invited: false });
    this.both.step();
  }

  reset(): Promise<void> {
    this.store.set({ problem: null });
    return this.both.reset();
  }

  /** Takes that vertex of both cloths; the hand is at it in one pane. */
  grab(vertex: number, pane: number): void {
    const places = PANES.map((one) => placeOf(this.view.positions(one), vertex));
    this.taken = { from: places[pane] ?? [0, 0, 0], places };
    for (const one of PANES) this.both.side(one)?.grab(vertex);
    this.play();
  }

  /** The hand has moved there; the other cloth is moved as far. */
  moveGrab(target: Triple): void {
    if (!this.taken) return;
    const { from, places } = this.taken;
    const way = target.map((metres, axis) => metres - (from[axis] ?? 0));
    places.forEach((place, pane) => {
      const [x, y, z] = place.map((metres, axis) => metres + (way[axis] ?? 0));
      this.both.side(pane)?.moveGrab([x ?? 0, y ?? 0, z ?? 0]);
    });
  }

  releaseGrab(): void {
    this.taken = null;
    for (const one of PANES) this.both.side(one)?.releaseGrab();
  }

  /** Says that a run has ended or shows nonsense, and waits for a reset. */
  private tell(frames: readonly (FrameMessage | null)[]): void {
    const { pair } = this.store.get();
    frames.forEach((frame, pane) => {
      const { message = '', numbers } = frame?.report ?? {};
      const worst = numbers?.warnings.find(({ is_nonsense }) => is_nonsense);
      if (!frame?.hasEnded && !worst) return;
      const what = worst ? warningSentence(worst) : `Its run has ended: ${message}`;
      this.pause();
      this.store.set({ phase: 'stopped', problem: inputFailure(`${pair[pane]}: ${what}`) });
    });
  }

  private measure(): void {
    const [a, b] = PANES.map((pane) => this.view.positions(pane));
    this.store.set({ apartM: a && b ? farthestApart(a, b) : 0 });
  }
}
