// The state of the view of refinement.
import { type Failure, inputFailure } from '../../shared/bindings/answers';
import type { RunWarning } from '../../shared/bindings/run-warning';
import type { FaultsAnswer } from '../bindings/refinement-module';
import type { Fit } from './fit';
import { FIRST_PICTURE, USUAL_DEMANDS_MM } from './garment-frames';
import { type GarmentId, type MethodId, MOTIONS, type MotionId, usualFabric } from './garments';
import type { PlanFile } from './plan-file';

export const PANES = ['coarse', 'even', 'planned', 'fine'] as const;
export type PaneId = (typeof PANES)[number];

/** The uniform meshes that a plan can be held against. */
export const RIVALS = ['coarse', 'even'] as const;
export type RivalId = (typeof RIVALS)[number];

export const PANE_TITLES: Record<PaneId, string> = {
  coarse: 'Coarse',
  even: 'Even',
  planned: 'Multi-resolution',
  fine: 'Fine',
};

export const COLOURS = ['material', 'level', 'pattern', 'curvature', 'distance'] as const;
/** More would take minutes for a second of motion. */
export const MOST_SUBSTEPS = 64;

export type ColourId = (typeof COLOURS)[number];

/** How much of the examples' shapes a plan may lose [mm]. */
export const DEMANDS = { least: 0.5, most: 4, step: 0.1 };

/**
 * Source of a pane's frames: a record that comes with the page, this device, or, until it plays,
 * the fine pane's shape as this mesh could show it.
 */
export type FrameSource = 'recorded' | 'computed' | 'sampled' | 'resting';

export interface GarmentPane {
  nVertices: number;
  source: FrameSource;
  /** Time of the work for one frame [ms], in parts. */
  msPerFrame: number | null;
  parts: { name: string; ms: number }[];
  /** Distance of the shown cloth from the fine pane's at the same points, root mean square [m]. */
  distanceM: number | null;
  /** Loss of the mesh of the fine pane's shape by its faces alone [m], and of its normals [rad]. */
  lostM: number | null;
  lostNormalsRad: number | null;
  /** How differently it is folded from the fine pane, and how far the surfaces are [m]. */
  foldsM: number | null;
  surfaceM: number | null;
  faults: FaultsAnswer | null;
  /** Signs in the steps computed here that the scene cannot explain. */
  warnings: readonly RunWarning[];
}

export const EMPTY_PANE: GarmentPane = {
  nVertices: 0,
  source: 'resting',
  msPerFrame: null,
  parts: [],
  distanceM: null,
  lostM: null,
  lostNormalsRad: null,
  foldsM: null,
  surfaceM: null,
  faults: null,
  warnings: [],
};

/** The state that a link carries. */
export interface RefinementLink {
  garment: GarmentId;
  motion: MotionId;
  fabric: string;
  /** Motions, in this fabric, that the plan is made of beside the example that comes with the page. */
  further: readonly MotionId[];
  /** Slider that rules, of the two. */
  rule: 'demand' | 'budget';
  /** Part of the examples' shapes that may be lost [mm]. */
  demand: number;
  /** Vertices; null until it was first moved. */
  budget: number | null;
  /** The uniform mesh beside the planned one. */
  rival: RivalId;
  /** Method of all panes; nothing but `implicit` comes recorded. */
  method: MethodId;
  /** Substeps of a step, where a warning asked for more than the scene's own; else null. */
  substeps: number | null;
  /** Frames that come with the page are shown where there are some. */
  useRecords: boolean;
  /** When no frames of the fine mesh come with the page, the other panes wait for it. */
  computeFine: boolean;
  /** Panes show the fine one's shape as well as their faces can, in place of their own run. */
  fineCloth: boolean;
  colour: ColourId;
  edges: boolean;
  hanging: boolean;
  speed: number;
  /** The time at which the view starts, if frames come with the page [s]. */
  startS: number;
}

/** How far apart chance alone puts two runs: the fine one, and one in air heavier by a millionth [m]. */
export interface FineFloor {
  foldsM: number;
  surfaceM: number;
}

export interface Doing {
  what: string;
  canCancel: boolean;
  /** How much of a further example has run, 0 to 1; null when none runs. */
  share: number | null;
}

export interface RefinementState extends RefinementLink {
  phase: 'loading' | 'ready' | 'stopped' | 'broken';
  playing: boolean;
  timeS: number;
  /** The time at which the frames end [s]. */
  endS: number;
  panes: Record<PaneId, GarmentPane>;
  /** Distance between two runs on the fine mesh, where that is known. */
  floor: FineFloor | null;
  plan: PlanFile | null;
  /** Vertices that a budget can ask for. */
  budgetRange: [number, number] | null;
  fit: Fit | null;
  /** The face that was asked about, by its place in the plan's mesh. */
  face: number | null;
  /** Upper ends of the scales. */
  ranges: { curvature: number; distance: number };
  /** The stage has room for two panes only: fine and the one beside it. */
  isNarrow: boolean;
  beside: 'rival' | 'planned';
  doing: Doing | null;
  problem: Failure | null;
}

export const DEFAULT_LINK: RefinementLink = {
  garment: FIRST_PICTURE.garment,
  motion: FIRST_PICTURE.motion,
  fabric: usualFabric(FIRST_PICTURE.garment),
  further: [],
  rule: 'demand',
  demand: USUAL_DEMANDS_MM[FIRST_PICTURE.garment],
  budget: null,
  rival: 'coarse',
  method: 'implicit',
  substeps: null,
  useRecords: true,
  computeFine: true,
  fineCloth: false,
  colour: 'distance',
  edges: false,
  hanging: false,
  speed: 1,
  startS: FIRST_PICTURE.startS,
};

/** The panes on the stage, from left to right. A fine mesh that rests while the others move has none. */
export function shownPanes(
  state: Pick<RefinementState, 'panes' | 'computeFine' | 'isNarrow' | 'beside' | 'rival'>,
): readonly PaneId[] {
  const { source, nVertices } = state.panes.fine;
  const { rival } = state;
  if (!state.computeFine && source === 'resting' && nVertices > 0) return [rival, 'planned'];
  if (state.isNarrow) return [state.beside === 'rival' ? rival : 'planned', 'fine'];
  return comparedPanes(state);
}

/** The panes that are in step, whether there is room for all or not. */
export function comparedPanes({ rival }: Pick<RefinementState, 'rival'>): readonly PaneId[] {
  return [rival, 'planned', 'fine'];
}

/** The panes beside fine show its shape in place of their own. */
export function showsFineCloth({
  fineCloth,
  panes,
}: Pick<RefinementState, 'fineCloth' | 'panes'>): boolean {
  return fineCloth && panes.fine.source !== 'resting';
}

/** Some pane shows what was computed on this device, step by step. */
export function isComputedHere(state: Pick<RefinementState, 'panes' | 'rival'>): boolean {
  return comparedPanes(state).some((id) => state.panes[id].source === 'computed');
}

/** Any of the times can be shown at once: nothing that is seen has to be computed on the way there. */
export function canSeek(state: Pick<RefinementState, 'phase' | 'panes' | 'rival'>): boolean {
  if (state.phase !== 'ready') return false;
  const sources = comparedPanes(state).map((id) => state.panes[id].source);
  return sources.every((source) => source === 'recorded' || source === 'sampled');
}

/** The shown motion is one of those that the plan is made of. */
export function isExample({ garment, motion, fabric, further }: RefinementLink): boolean {
  if (further.includes(motion)) return true;
  return motion === MOTIONS[0].value && fabric === usualFabric(garment);
}

/** The shown motion does not fit the plan's examples, and can become one of them. */
export function canPlanAnew(state: RefinementState): boolean {
  const { phase, fit } = state;
  return phase === 'ready' && fit !== null && fit.first_fired !== null && !isExample(state);
}

export function initialRefinementState(
  link: RefinementLink,
  problems: readonly string[],
): RefinementState {
  return {
    ...link,
    phase: 'loading',
    playing: false,
    timeS: 0,
    endS: 0,
    panes: { coarse: EMPTY_PANE, even: EMPTY_PANE, planned: EMPTY_PANE, fine: EMPTY_PANE },
    floor: null,
    plan: null,
    budgetRange: null,
    fit: null,
    face: null,
    ranges: { curvature: 0, distance: 0 },
    isNarrow: false,
    beside: 'planned',
    doing: null,
    problem:
      problems.length > 0
        ? inputFailure(`The link was read in part. ${problems.join('; ')}.`)
        : null,
  };
}
