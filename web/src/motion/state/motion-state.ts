// Everything the page shows. Only this and the frames travel between its parts.
import type { Collider } from '../../shared/bindings/geometry';
import type {
  EnergyNumbers,
  MeshLevels,
  ResponseStudy,
  RunNumbers,
  SceneSummary,
  SpringSplit,
} from '../../shared/bindings/pleat-module';
import type { RunWarning } from '../../shared/bindings/run-warning';
import type { HeatMap, HeatScale } from '../../shared/stage/heat-map';
import type { ImexSaving } from './imex-saving';
import type { MotionLink } from './motion-link';
import type { ObjMesh } from './obj-mesh';
import type { Setting } from './setting';
import type { StepCosts } from './step-cost';
import { NO_SWEEP, type SweepState } from './sweep-state';

export type Phase = 'loading' | 'ready' | 'stopped' | 'refused' | 'broken';

/** A stretch of a run in one setting. */
export interface Leg {
  setting: Setting;
  mesh: ObjMesh | null;
  /** Steps of the run when it began. */
  fromStep: number;
}

/** A state of a run: where so many steps of its course lead. */
export interface Way {
  course: readonly Leg[];
  step: number;
}

/** The change that helps, and the words for it. */
export interface Remedy {
  title: string;
  setting: Setting;
  /** State of the run that it goes on from, and then plays. */
  from?: Way;
  /** True when it starts the run anew, which then plays; else the motion goes on. */
  startsAnew?: boolean;
}

export interface Problem {
  /**
   * The part at fault: the link, the settings, a file, the run's numbers, the worker that computes, the
   * graphics, or the browser itself.
   */
  source: 'link' | 'setting' | 'file' | 'run' | 'worker' | 'picture' | 'browser';
  sentence: string;
  /** Kind of the run's warning that it is. */
  warning?: RunWarning['kind'];
  /** Vertex at which the cloth is at its worst. */
  vertex?: number;
  /** Words on what helps, as far as that is known by now. */
  help?: string;
  remedy?: Remedy;
}

/**
 * Times of one step, from differences of running totals over at least 50 ms of work. The parts add
 * up to the total: the last one is the rest.
 */
export interface StepTiming {
  totalMs: number;
  parts: { name: string; ms: number }[];
  /** The part that is contact of the cloth with itself, where there is any. */
  clothContactMs?: number;
}

/** `refused`: why the scene tells nothing of responses. */
export type ResponseStory = 'unasked' | 'coming' | { refused: string } | ResponseStudy;

export interface MotionState extends MotionLink {
  phase: Phase;
  playing: boolean;
  /** Simulated seconds a second of the clock: 1, 1/2 or 1/4. */
  speed: number;
  /** The cloth is being held. */
  held: boolean;
  /** Nobody has grabbed or played yet: the invitation is shown. */
  invited: boolean;
  /** The mesh of "Your OBJ": the visitor's or the example, null until one is there. */
  mesh: ObjMesh | null;
  /** Name of the visitor's file that is being read. */
  reading: string | null;
  summary: SceneSummary | null;
  numbers: RunNumbers | null;
  timing: StepTiming | null;
  /** Energies of the frames since the account was opened or the run began; empty while it is closed. */
  energies: readonly EnergyNumbers[];
  /** The split when it was last asked for: while `springs` is on, of the loaded cloth. */
  springSplit: SpringSplit | null;
  /** While one of them is drawn, those of the loaded cloth; null until they are known. */
  coarseLevels: MeshLevels | null;
  /** Substeps that the slider is dragged to, until it is let go. */
  draggedSubsteps: number | null;
  /** Savings of imex at the substeps that its slider shows; null until that is known. */
  imexSaving: ImexSaving | null;
  /** How much of the way to the start is run through, 0 to 1; null when nothing is. */
  ahead: number | null;
  /** The question that the worker has been at for a while, and for how long by now [s]. */
  busy: { type: string; seconds: number } | null;
  /** Settings in which the run has come to its present time, unless a hand pulled it there. */
  course: readonly Leg[];
  /** Why the shown state is not what its link replays. */
  astray: 'pulled' | 'changed' | null;
  /** State of the reference that the shown cloth is compared with. */
  reference: 'unasked' | 'coming' | 'failed' | 'here';
  /** Times that a step was measured to take on this device. */
  costs: StepCosts;
  /** Simulated seconds a second of the clock, as reached. */
  pace: number | null;
  /** The last step's solve reached its iteration cap. */
  isCutShort: boolean;
  colliders: Collider[];
  /** Motion of the cloth after first contact, as it was last studied. */
  response: ResponseStory;
  heatScale: HeatScale | null;
  problem: Problem | null;
  sweep: SweepState;
  sweepOpen: boolean;
}

export function initialMotionState(link: MotionLink, problems: string[]): MotionState {
  return {
    ...link,
    phase: 'loading',
    playing: false,
    speed: 1,
    held: false,
    invited: true,
    mesh: null,
    reading: null,
    summary: null,
    numbers: null,
    timing: null,
    energies: [],
    springSplit: null,
    coarseLevels: null,
    draggedSubsteps: null,
    imexSaving: null,
    ahead: null,
    busy: null,
    course: [],
    astray: null,
    reference: 'unasked',
    costs: {},
    pace: null,
    isCutShort: false,
    colliders: [],
    response: 'unasked',
    heatScale: null,
    problem:
      problems.length > 0
        ? { source: 'link', sentence: `The link could not be read fully. ${problems.join('; ')}.` }
        : null,
    sweep: NO_SWEEP,
    sweepOpen: false,
  };
}

/** State when another scene is shown: it starts still, from its first view. */
export const AT_START = {
  startSteps: 0,
  playing: false,
  invited: true,
  camera: null,
} as const satisfies Partial<MotionState>;

/** A reference is some hundred kilobytes: it comes when a distance is asked for. */
export function wantsReference({ compare, heat }: Pick<MotionState, 'compare' | 'heat'>): boolean {
  return compare || heat === 'distance';
}

/** The heat map that can be shown: distance only where there is a reference. */
export function shownHeat({ heat, numbers }: Pick<MotionState, 'heat' | 'numbers'>): HeatMap {
  return heat === 'distance' && !numbers?.reference ? 'off' : heat;
}
