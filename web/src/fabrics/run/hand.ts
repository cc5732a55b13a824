// A visitor's hand: takes the cloth, moves it, and puts pins in and out.
import type { Triple } from '../../shared/bindings/geometry';
import type { Store } from '../../shared/state/store';
import { type FabricsState, settlingPanes } from '../state/fabrics-state';
import { baseOf, type Hold, holdAt } from '../state/holds';
import type { HeldCloth } from './held-cloth';

/** A press moves nothing until the hand is this part of its grasp away. */
const LEAST_MOVE = 1e-3;

/** The hold that a hand has taken; `isNew` is a hold that is not there until it is moved. */
interface Taken {
  name: string;
  base: Triple;
  isNew: Hold | null;
}

export class Hand {
  private taken: Taken | null = null;

  constructor(
    private readonly store: Store<FabricsState>,
    private readonly held: () => HeldCloth,
    /** Place of a vertex in a pane [m]. */
    private readonly place: (vertex: number, pane: number) => Triple,
  ) {}

  hasTaken(): boolean {
    return this.taken !== null;
  }

  /** Another cloth is shown. */
  drop(): void {
    this.taken = null;
  }

  grab(vertex: number, pane: number): void {
    const known = this.held().at(vertex);
    const hold = known ?? this.newHold(vertex, pane, 'handle');
    const base = hold && baseOf(hold, vertex);
    if (!hold || !base) return;
    this.taken = { name: hold.name, base, isNew: known ? null : hold };
    this.store.set({ isDragging: true, invited: false, chosenHold: hold.name });
  }

  /** Moves the taken vertex to this place [m]. */
  move([x, y, z]: Triple): void {
    if (!this.taken) return;
    const { name, base, isNew } = this.taken;
    const offset: Triple = [x - base[0], y - base[1], z - base[2]];
    if (!isNew) return this.held().move(name, offset);
    const way = Math.hypot(...offset.map((metres, axis) => metres - (isNew.offset[axis] ?? 0)));
    if (way < LEAST_MOVE * (this.store.get().cloth?.grasp_m ?? 0)) return;
    this.taken.isNew = null;
    this.held().set([...this.held().holds(), { ...isNew, offset }]);
  }

  release(): void {
    const wasMoved = this.taken !== null && this.taken.isNew === null;
    this.taken = null;
    this.store.set({ isDragging: false });
    if (!wasMoved) return;
    this.store.set({ panes: settlingPanes(this.store.get().panes) });
    this.held().rest();
  }

  /** Puts a pin around a vertex, or takes out the hold that has it. */
  togglePin(vertex: number, pane: number): void {
    const known = this.held().at(vertex);
    const pin = known ? null : this.newHold(vertex, pane, 'pin');
    const others = this.held()
      .holds()
      .filter((hold) => hold !== known);
    this.store.set({ invited: false, problem: null });
    this.held().set(pin ? [...others, pin] : others);
  }

  /** A new hold that has `vertex` where it is seen. */
  private newHold(vertex: number, pane: number, kind: Hold['kind']): Hold | null {
    const { cloth } = this.store.get();
    const hold = cloth && holdAt(cloth, vertex, kind, this.held().holds());
    if (!hold) return null;
    const [x, y, z] = this.place(vertex, pane);
    const [bx, by, bz] = baseOf(hold, vertex) ?? [0, 0, 0];
    return { ...hold, offset: [x - bx, y - by, z - bz] };
  }
}
