// Turns the state into the shapes that the stage draws.

import type { Store } from '../../shared/state/store';
import type { Energy } from '../bindings/modal-module';
import type { ModesState } from '../state/modes-state';
import { straightAt } from '../state/timeline';
import type { Body } from './body';
import { Swing, swung } from './swing';

export interface ShapeView {
  /** One pane or two, the second for the other energy. */
  setPanes(count: number): void;
  showShape(pane: number, positions: Float32Array): void;
  /** The straight way between keys, or null. */
  showGhost(positions: Float32Array | null): void;
}

/** The energy whose shape is drawn in each pane. */
export function shownEnergies({
  showing,
  compares,
  energy,
}: Pick<ModesState, 'showing' | 'compares' | 'energy'>): Energy[] {
  return showing === 'modes' && compares ? ['volume', 'surface'] : [energy];
}

export class Showing {
  private readonly swing: Swing;
  private body: Body | null = null;
  private panes: Float32Array[] = [];
  private ghost = new Float32Array(0);

  constructor(
    private readonly store: Store<ModesState>,
    private readonly view: ShapeView,
  ) {
    this.swing = new Swing(store, () => this.draw());
    store.subscribe((state, previous) => {
      const watched = [
        'amplitudes',
        'showing',
        'compares',
        'energy',
        'found',
        'time',
        'keys',
        'completion',
        'ghost',
        'playing',
      ] as const;
      if (watched.some((key) => state[key] !== previous[key])) this.draw();
    });
  }

  take(body: Body): void {
    this.body = body;
    this.panes = [0, 1].map(() => new Float32Array(body.shape.length));
    this.ghost = new Float32Array(body.shape.length);
  }

  /** Places that are drawn in a pane; empty before there is anything. */
  positions(pane: number): Float32Array {
    return this.panes[pane] ?? new Float32Array(0);
  }

  draw(): void {
    const { body } = this;
    if (!body) return;
    const state = this.store.get();
    const energies = shownEnergies(state);
    this.view.setPanes(energies.length);
    if (state.showing === 'keys') this.drawKeys(body, state);
    else
      energies.forEach((energy, pane) => {
        this.drawMix(body, state, energy, pane);
      });
    const hasGhost = state.showing === 'keys' && state.ghost && state.completion !== null;
    if (hasGhost) straightAt(this.ghost, state.keys, state.time);
    this.view.showGhost(hasGhost ? this.ghost : null);
  }

  private drawKeys(body: Body, { keys, time }: ModesState): void {
    const target = this.positions(0);
    if (!body.between(target, time)) target.set(keys[0]?.positions ?? body.shape);
    this.view.showShape(0, target);
  }

  private drawMix(body: Body, state: ModesState, energy: Energy, pane: number): void {
    const { playing, amplitudes, found } = state;
    const now = playing ? swung(amplitudes, found?.modes ?? [], this.swing.seconds) : amplitudes;
    const target = this.positions(pane);
    body.mix(target, energy, now);
    this.view.showShape(pane, target);
  }
}
