// State of the view "Modes". Only this and the frames travel between its parts.
import { type Failure, inputFailure } from '../../shared/bindings/answers';
import type { ObjUnit } from '../../shared/state/obj-file';
import type { Energy, FilledFrame, SurfaceAnswer, VolumeChoice } from '../bindings/modal-module';
import { firstKeys, type KeyOrigin, type KeyShape } from './key-shapes';
import type { ModeNumbers } from './material';
import type { BarCells } from './models';

/** Modes that swing, or the motion through the key shapes. */
export type Showing = 'modes' | 'keys';

export const ENERGIES: readonly Energy[] = ['volume', 'surface', 'cloth'];
export const COUNTS = [6, 12, 20, 40] as const;
export type ModeCount = (typeof COUNTS)[number];

/** Modes that were found for the present model, energy and count. */
export interface FoundModes {
  energy: Energy;
  modes: readonly ModeNumbers[];
  rigid: number;
  tets: number;
}

/** The in-betweens of the present keys. */
export interface Completion {
  frames: readonly FilledFrame[];
  tets: number;
  bodies: number;
  /** Shares of the motion between the keys in the rigid motions, then with one mode more each; null if unknown. */
  shares: readonly number[] | null;
}

export interface ModesState {
  phase: 'loading' | 'ready' | 'broken';
  model: string;
  cells: BarCells;
  volume: VolumeChoice;
  surface: SurfaceAnswer | null;
  energy: Energy;
  /** Volume and surface energy side by side. */
  compares: boolean;
  count: ModeCount;
  found: FoundModes | null;
  /** How far each mode swings, -1 to 1; those beyond the list's end are 0. */
  amplitudes: readonly number[];
  showing: Showing;
  playing: boolean;
  speed: number;
  /** Time on the timeline: the first key is at 0, the next at 1. */
  time: number;
  keys: readonly KeyShape[];
  /** The key that is replaced or deleted. */
  chosenKey: number;
  completion: Completion | null;
  /** Shares of the draping cloth in its own modes; null for others. */
  drapeShares: readonly number[] | null;
  ghost: boolean;
  edges: boolean;
  /** Words on what is being computed and takes long. */
  working: string | null;
  objName: string | null;
  objUnit: ObjUnit;
  objOdd: string | null;
  invited: boolean;
  problem: Failure | null;
}

export interface ModesLink
  extends Pick<
    ModesState,
    | 'model'
    | 'cells'
    | 'volume'
    | 'energy'
    | 'compares'
    | 'count'
    | 'amplitudes'
    | 'showing'
    | 'time'
    | 'ghost'
    | 'edges'
  > {
  keys: readonly KeyOrigin[];
}

/** The energies by which a model has modes. */
export function energiesOf(model: string): readonly Energy[] {
  return model === 'cloth' ? ENERGIES : ENERGIES.filter((energy) => energy !== 'cloth');
}

/** True where what is inside the surface is the body's own, and not a thickness that is made up. */
export function isSolid({ surface, volume }: Pick<ModesState, 'surface' | 'volume'>): boolean {
  return (surface?.closed ?? false) && volume !== 'shell';
}

/** How a model is shown that comes without a link. */
export function usualLink(model: string): ModesLink {
  return {
    model,
    cells: 3,
    volume: 'auto',
    energy: model === 'cloth' ? 'cloth' : 'volume',
    compares: false,
    count: 12,
    amplitudes: [model === 'cloth' ? 1 : 0.25], // a solid body keeps its volume
    showing: 'modes',
    time: 0.5,
    ghost: true,
    edges: false,
    keys: firstKeys(model),
  };
}

export function linkFailure(problems: readonly string[]): Failure | null {
  if (problems.length === 0) return null;
  return inputFailure(`The link could not be read fully. ${problems.join('; ')}.`);
}

export function initialModesState(link: ModesLink, problems: readonly string[]): ModesState {
  const { keys: _, ...shown } = link;
  return {
    ...shown,
    phase: 'loading',
    surface: null,
    found: null,
    playing: false,
    speed: 1,
    keys: [],
    chosenKey: 0,
    completion: null,
    drapeShares: null,
    working: null,
    objName: null,
    objUnit: 'm',
    objOdd: null,
    invited: true,
    problem: linkFailure(problems),
  };
}
