// Asks for the modes of the present body, each energy once.
import type { Failure } from '../../shared/bindings/answers';
import type { Store } from '../../shared/state/store';
import { answerOf } from '../../shared/workers/asked';
import type { Energy, VolumeWish } from '../bindings/modal-module';
import { modeNumbers } from '../state/material';
import { enclosedVolume } from '../state/mix';
import { barEdge } from '../state/models';
import { type FoundModes, isSolid, type ModesState } from '../state/modes-state';
import type { ModesMessage } from '../worker/modal-protocol';
import type { Body } from './body';
import type { ModalClient } from './modal-client';
import { noticed } from './slow-work';

/** Cubes in a closed body that comes from a file: as many as a page waits a second or two for. */
const CUBES = 1500;

/** The volume that carries the present model's surface. */
export function volumeWish(
  { model, cells, volume, count, surface }: ModesState,
  { shape, triangles }: Body,
): VolumeWish {
  const wish: VolumeWish = { volume, modes: count };
  if (!isSolid({ surface, volume })) return wish;
  if (model === 'bar') return { ...wish, size_m: barEdge(cells) };
  return { ...wish, size_m: Math.cbrt(enclosedVolume(shape, triangles) / CUBES) };
}

export class ModeFinder {
  private known = new Map<Energy, FoundModes>();

  constructor(
    private readonly store: Store<ModesState>,
    private readonly client: ModalClient,
    private readonly refuse: (failure: Failure) => void,
  ) {}

  /** Another body, count or volume: nothing is known of it. */
  forget(body: Body): void {
    this.known = new Map();
    body.dropMoves();
  }

  found(energy: Energy): FoundModes | null {
    return this.known.get(energy) ?? null;
  }

  /** True once the modes of that energy are known. */
  async ensure(body: Body, energy: Energy): Promise<boolean> {
    if (this.known.has(energy)) return true;
    const { known } = this;
    const wish = volumeWish(this.store.get(), body);
    const question = answerOf(this.client.ask({ type: 'modes', energy, wish }), this.refuse);
    const answer = await noticed(this.store, 'Finding the modes', question);
    if (!answer || known !== this.known) return false;
    this.take(body, answer);
    return true;
  }

  private take(body: Body, { energy, answer, moves }: ModesMessage): void {
    body.setMoves(energy, moves);
    const { stiffness, rigid, tets } = answer;
    const modes = modeNumbers(stiffness, energy, isSolid(this.store.get()));
    this.known.set(energy, { energy, modes, rigid, tets });
  }
}
