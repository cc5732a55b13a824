// Key shapes: what each was made from, and how it is made again.
import type { Energy } from '../bindings/modal-module';

export type KeyOrigin =
  | { kind: 'rest' }
  | { kind: 'bent'; degrees: number }
  | { kind: 'mix'; energy: Energy; amplitudes: readonly number[] }
  /** A frame of the cloth as it drapes. */
  | { kind: 'drape'; frame: number }
  | { kind: 'file'; name: string };

export interface KeyShape {
  origin: KeyOrigin;
  /** Three numbers a vertex [m]. */
  positions: Float64Array;
}

/** Frames of the draping cloth that are kept, and those that its keys are taken from. */
export const DRAPE_FRAMES = 61;
export const DRAPE_FRAMES_PER_S = 30;
export const DRAPE_KEYS: readonly number[] = [0, 20, 40, 60];

/** A full turn would leave no radius to speak of for what is thick. */
export const MOST_DEGREES = 360;

/** A body along x bent to an arc in the plane of x and y, its middle line keeping its length. */
export function bent(straight: Float64Array, degrees: number): Float64Array {
  if (degrees === 0) return straight.slice();
  let [low, high] = [Infinity, -Infinity];
  for (let k = 0; k < straight.length; k += 3) {
    low = Math.min(low, straight[k] as number);
    high = Math.max(high, straight[k] as number);
  }
  const radius = (high - low) / ((degrees * Math.PI) / 180);
  const middle = (low + high) / 2;
  const result = straight.slice();
  for (let k = 0; k < straight.length; k += 3) {
    const turn = ((straight[k] as number) - middle) / radius;
    const out = radius - (straight[k + 1] as number);
    result[k] = middle + out * Math.sin(turn);
    result[k + 1] = radius - out * Math.cos(turn);
  }
  return result;
}

/** A key's name, short enough for a button. */
export function keyTitle(origin: KeyOrigin): string {
  switch (origin.kind) {
    case 'rest':
      return 'At rest';
    case 'bent':
      return `Bent ${origin.degrees}°`;
    case 'mix':
      return 'Mix';
    case 'drape':
      return `${(origin.frame / DRAPE_FRAMES_PER_S).toFixed(1)} s`;
    case 'file':
      return origin.name.replace(/\.obj$/i, '');
  }
}

/** Origins of the keys that need no file; none where these are too few for a motion. */
export function remade(keys: readonly KeyShape[]): KeyOrigin[] {
  const origins = keys.map(({ origin }) => origin).filter(({ kind }) => kind !== 'file');
  return origins.length >= 2 ? origins : [];
}

/** The keys that a model starts with. */
export function firstKeys(model: string): KeyOrigin[] {
  if (model === 'cloth') return DRAPE_KEYS.map((frame) => ({ kind: 'drape', frame }));
  if (model === 'bar' || model === 'sheet')
    return [{ kind: 'rest' }, { kind: 'bent', degrees: 180 }];
  return [{ kind: 'rest' }, { kind: 'mix', energy: 'volume', amplitudes: [0.8, 0.4] }];
}
