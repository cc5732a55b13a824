// State of the strips over an edge.
import type { Failure } from '../../shared/bindings/answers';
import { namesByBendingLength } from './strips';

export interface StripsState {
  /** `running`: strips come to rest, one after the other; `stopped`: not all did, and more can be asked for. */
  phase: 'running' | 'done' | 'stopped' | 'broken';
  /** Degrees by which each droops that has come to rest, by its fabric. */
  droops: Readonly<Record<string, number>>;
  /** Fabric of the strip that is read. */
  chosen: string;
  problem: Failure | null;
}

export function initialStripsState(): StripsState {
  const [chosen = ''] = namesByBendingLength();
  return { phase: 'stopped', droops: {}, chosen, problem: null };
}

/** The fabrics whose strips have come to rest, the one first that droops least; those that have not yet follow. */
export function sortedStrips({ droops }: Pick<StripsState, 'droops'>): string[] {
  const droop = (name: string) => droops[name] ?? Number.POSITIVE_INFINITY;
  return namesByBendingLength().sort((a, b) => (droop(a) === droop(b) ? 0 : droop(a) - droop(b)));
}
