// The holds of the cloth: on the page, in the worker, and as the worker has granted them.
import { type Failure, inputFailure } from '../../shared/bindings/answers';
import type { Store } from '../../shared/state/store';
import { answerOf } from '../../shared/workers/asked';
import { type FabricsState, heldBy, settlingPanes } from '../state/fabrics-state';
import { type Hold, joined } from '../state/holds';
import type { DeformClient } from './deform-client';
import { LastGranted } from './last-granted';

/** A hand that has not moved for so long rests [ms]. */
const REST_AFTER_MS = 150;

/** A failure of what was just changed, for somebody who sees pins and not a scene's file. */
export function undone(failure: Failure): Failure {
  if (failure.where !== '/pins') return failure;
  const what = failure.what.charAt(0).toUpperCase() + failure.what.slice(1);
  return inputFailure(
    `Undone: without recovery, pins and handles have to say where all of the cloth is. ${what}.`,
  );
}

export class HeldCloth {
  private readonly granted = new LastGranted<readonly Hold[]>([]);
  private restTimer = 0;

  constructor(
    private readonly store: Store<FabricsState>,
    /** Null while the worker has no cloth. */
    private readonly client: () => DeformClient | null,
    /** A hand has the cloth now. */
    private readonly isTaken: () => boolean,
  ) {}

  /** Another cloth, which is held by `own` before anybody changes that. */
  open(own: readonly Hold[], holds: readonly Hold[]): void {
    this.granted.value = own;
    this.store.set(heldBy(holds));
  }

  holds(): readonly Hold[] {
    return this.store.get().holds;
  }

  /** The hold that has a vertex. */
  at(vertex: number): Hold | undefined {
    return this.holds().find((hold) => hold.vertices.includes(vertex));
  }

  /** Other vertices are held. */
  set(holds: readonly Hold[]): void {
    this.store.set(heldBy(holds));
    this.send();
  }

  /** Has the worker hold what the page says is held. */
  send(): void {
    const { store } = this;
    const client = this.client();
    store.set({ panes: settlingPanes(store.get().panes) });
    if (!client) return;
    const { vertices, places } = joined(this.holds());
    const message = { type: 'hold', vertices, places } as const;
    const asked = this.granted.ask(client.ask(message, [vertices.buffer, places.buffer]), {
      granted: () => this.holds(),
      refused: () => this.undo(),
    });
    void answerOf(asked, (failure) => store.set({ problem: undone(failure) }));
  }

  /** The hold of that name is moved by `offset` from where it was by itself: never refused. */
  move(name: string, offset: Hold['offset']): void {
    const holds = this.holds().map((hold) => (hold.name === name ? { ...hold, offset } : hold));
    this.store.set(heldBy(holds));
    if (this.granted.isSettled()) this.granted.value = holds;
    const { places } = joined(holds);
    this.client()?.tell({ type: 'move', places }, [places.buffer]);
    window.clearTimeout(this.restTimer);
    this.restTimer = window.setTimeout(() => this.rest(), REST_AFTER_MS);
  }

  /** Nothing moves for now. */
  rest(): void {
    window.clearTimeout(this.restTimer);
    this.client()?.tell({ type: 'rest', isHeld: this.isTaken() });
  }

  /** Nothing is asked for any more of what was held. */
  drop(): void {
    window.clearTimeout(this.restTimer);
  }

  private undo(): void {
    if (this.granted.value === this.holds()) return;
    this.set(this.granted.value);
  }
}
