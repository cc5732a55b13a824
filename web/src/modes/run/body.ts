// The body that is shown: what the worker found of it, and the shapes that its keys and mixes stand for.

import type { Triple } from '../../shared/bindings/geometry';
import { extentOf } from '../../shared/state/vectors';
import type { Energy, FilledFrame } from '../bindings/modal-module';
import { bent, type KeyOrigin, type KeyShape } from '../state/key-shapes';
import type { ModeNumbers } from '../state/material';
import { mixInto, quietAmplitude, REACH } from '../state/mix';
import { pulledMix, timeNearest } from '../state/pull';
import { shapeAt } from '../state/timeline';
import type { CompletedMessage, OpenedMessage } from '../worker/modal-protocol';

export class Body {
  readonly triangles: Uint32Array;
  /** The shape that modes are about, three numbers a vertex [m]. */
  readonly shape: Float64Array;
  readonly drape: Float64Array;
  /** Farthest move of a vertex at full amplitude [m]. */
  readonly reach: number;
  private readonly moves = new Map<Energy, Float32Array>();
  private filled: { positions: Float32Array; frames: readonly FilledFrame[] } | null = null;

  constructor({ triangles, shape, drape }: OpenedMessage) {
    this.triangles = triangles;
    this.shape = shape;
    this.drape = drape;
    this.reach = REACH * extentOf(shape);
  }

  get nVertices(): number {
    return this.shape.length / 3;
  }

  setMoves(energy: Energy, moves: Float32Array): void {
    this.moves.set(energy, moves);
  }

  dropMoves(): void {
    this.moves.clear();
  }

  setFilled({ filled, frames }: Pick<CompletedMessage, 'filled' | 'frames'>): void {
    this.filled = { positions: filled, frames };
  }

  /** Writes the mix of an energy's modes; those that are not known yet add nothing. */
  mix(target: Float32Array | Float64Array, energy: Energy, amplitudes: readonly number[]): void {
    mixInto(
      target,
      this.shape,
      this.moves.get(energy) ?? new Float32Array(0),
      amplitudes,
      this.reach,
    );
  }

  /** Amplitude of a mode at which a closed body keeps its volume. */
  quiet(energy: Energy, mode: number): number {
    const { shape, triangles, reach } = this;
    const move = this.moves.get(energy)?.subarray(mode * shape.length, (mode + 1) * shape.length);
    return move ? quietAmplitude(move, shape, triangles, reach) : 1;
  }

  /** Writes the completed motion at a time; false where there is none yet. */
  between(target: Float32Array, time: number): boolean {
    if (this.filled) shapeAt(target, this.filled.positions, this.filled.frames, time);
    return this.filled !== null;
  }

  /** The time at which a vertex is nearest to a place; null before the motion is there. */
  timeNearest(vertex: number, place: Triple): number | null {
    const { filled } = this;
    return filled && timeNearest(filled.positions, filled.frames, vertex, place);
  }

  /** The mix that takes a vertex to a place with least energy. */
  pulled(energy: Energy, modes: readonly ModeNumbers[], vertex: number, place: Triple): number[] {
    const moves = this.moves.get(energy) ?? new Float32Array(0);
    const move = place.map((value, axis) => value - (this.shape[3 * vertex + axis] ?? 0)) as Triple;
    return pulledMix(moves, modes, this.shape.length, vertex, this.reach, move);
  }

  /** The vertex that goes farthest: from the first key to the second, or else in the first mode. */
  liveliest(keys: readonly KeyShape[], energy: Energy): number {
    const moves = this.moves.get(energy);
    const [from, to] = [keys[0]?.positions, keys[1]?.positions];
    let best = { vertex: 0, move: -1 };
    for (let vertex = 0; vertex < this.nVertices; ++vertex) {
      const part = [0, 1, 2].map((axis) => {
        const at = 3 * vertex + axis;
        return from && to ? (to[at] ?? 0) - (from[at] ?? 0) : (moves?.[at] ?? 0);
      });
      const move = Math.hypot(...part);
      if (move > best.move) best = { vertex, move };
    }
    return best.vertex;
  }

  /** The shape of a key that is not from a file. */
  key(origin: Exclude<KeyOrigin, { kind: 'file' }>): KeyShape {
    switch (origin.kind) {
      case 'rest':
        return { origin, positions: this.shape.slice() };
      case 'bent':
        return { origin, positions: bent(this.shape, origin.degrees) };
      case 'mix': {
        const positions = new Float64Array(this.shape.length);
        this.mix(positions, origin.energy, origin.amplitudes);
        return { origin, positions };
      }
      case 'drape': {
        const from = origin.frame * this.shape.length;
        return { origin, positions: this.drape.slice(from, from + this.shape.length) };
      }
    }
  }
}
