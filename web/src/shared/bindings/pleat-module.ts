// The classes bound by the module of cloth in motion, and the shape of the texts they answer with.
import type { Triple } from './geometry';
import type { RunWarning } from './run-warning';

export interface SceneSummary {
  n_vertices: number;
  n_triangles: number;
  n_springs: number;
  n_bends: number;
  step_s: number;
  substeps: number;
  built: string[];
  left_out: string[];
  notes?: string[];
}

/** How the present state compares with a reference of its scene. */
export interface ReferenceNumbers {
  /** RMS by area; null beyond the reference's end, and when `disturbed`. */
  distance_m: number | null;
  /** How well the reference is known then; null when nobody knows. */
  uncertainty_m: number | null;
  end_s: number;
  description: string;
  /** A hand or another scene moved the cloth since its start. */
  disturbed: boolean;
}

/** Contact of a cloth with itself, since the run took its present scene. */
export interface ClothContactNumbers {
  /** Pairs of a vertex and a face, or of two edges, that are watched now, and those that touch. */
  n_pairs: number;
  n_touching: number;
  /** Times that pairs were looked for. */
  n_lists: number;
  bytes: number;
  /** Mean share of the vertices whose way the guard shortened in a substep. */
  held_back_share: number;
  /** Root mean square of the way that they lost, over all vertices and substeps. */
  rms_motion_lost_m: number;
  /** Substeps in which prescribed motions left the cloth no way. */
  n_blocked_substeps: number;
}

export interface RunNumbers {
  time_s: number;
  /** Steps since the run took its present scene, as the module tells them; the page counts from the start. */
  step: number;
  /** Largest and root mean square of |edge strain|, as ratios. */
  largest_stretch: number;
  rms_stretch: number;
  /** Relative residual of the last step's own equations. */
  residual: number;
  iterations: number;
  /** Length of the tautest thread over that at rest, were the cloth where a hand wants it; null without a hand. */
  asked_stretch: number | null;
  /** Total wall time since load, the first step not counted: of each part that was timed [ms]. */
  parts_ms: Record<string, number>;
  /** Missing where the scene has the cloth pass through itself. */
  cloth_contact?: ClothContactNumbers;
  /** Time of the steps as a whole [ms], of which there were `steps_timed`. */
  steps_ms: number;
  steps_timed: number;
  /** Warnings, at most one of each kind since the run began. */
  warnings: RunWarning[];
  /** Null where there is none of this scene. */
  reference: ReferenceNumbers | null;
}

/** Names of what `energies` holds, in this order. */
export const ENERGY_NUMBERS = [
  /** [s] */
  'time_s',
  /** Energies now [J]; that by height above what it was when the account began. */
  'kinetic',
  'elastic',
  'gravity',
  /** Works done on the cloth since then [J]: negative where they took energy. */
  'damping',
  'air',
  'contact',
  'pins',
  'tears',
  /** Energy that no work explains [J]. */
  'drift',
  /** Kinetic and elastic energy when the account began [J]. */
  'start',
] as const;

export type EnergyNumbers = Record<(typeof ENERGY_NUMBERS)[number], number>;

/** The springs of a mesh, and how its stepper takes them. */
export interface SpringSplit {
  /** Two vertices a spring. */
  ends: Uint32Array;
  /** 1 where a spring is implicit, 0 where not; empty where the stepper takes all alike. */
  isImplicit: Int8Array;
}

/** Vertices of a coarser level: by quadrics, or all but those with two neighbours that stay. */
export type LevelSelection = 'quadrics' | 'thinned';

/** A level coarser than the mesh, in vertices of the mesh. */
export interface MeshLevel {
  /** Ascending. */
  vertices: Uint32Array;
  /** Two vertices an edge. */
  edges: Uint32Array;
}

/** Ever coarser levels of a mesh. */
export interface MeshLevels {
  levels: readonly MeshLevel[];
  /** Why there are fewer than asked for; empty when there are all. */
  shortage: string;
}

/** How imex would take the springs of a mesh. */
export interface ImexShare {
  /** Substeps: as many as it is given, or as it takes for the share that shall be explicit. */
  substeps: number;
  /** Share of the springs that are implicit: 0 to 1. */
  share: number;
}

/** The answer of `readObj`. */
export interface ObjAnswer {
  /** The section "cloth" of a scene, with the mesh written out. */
  cloth: object;
  groups: string[];
  n_vertices: number;
  n_triangles: number;
  low_m: Triple;
  high_m: Triple;
  /** Some triangle has no texture coordinates. */
  needs_direction: boolean;
  /** Skipped statements, counted, in words; missing or empty when none was. */
  skipped?: string;
}

/** A cloth from its first contact on, under one response. */
export interface ResponseRun {
  /** RMS over the vertices touched so far, after each substep. */
  normal_velocities_m_per_s: number[];
  rms_normal_velocity_m_per_s: number;
  n_touched: number;
  /** Share of the time of a step. */
  contact_share: number;
}

/** One cloth twice from one state, where its normal velocity ends and where it is turned round. */
export interface ResponseStudy {
  first_contact_s: number;
  substep_s: number;
  resting: ResponseRun;
  uniform: ResponseRun;
}

export interface SceneHandle {
  fabrics(): string;
  /** The table of steppers, a StepperRow each, and of the details that they read. */
  steppers(): string;
  parse(sceneText: string): string;
  /** A ResponseStudy of so long after first contact [s]. */
  studyResponse(sceneText: string, windowS: number): string;
  /** The mesh of an OBJ file. `meshText`: the section "mesh" of a scene that names the file. */
  readObj(objText: string, meshText: string): string;
  delete(): void;
}

export interface SimulationHandle {
  load(sceneText: string): string;
  carryOver(sceneText: string): string;
  /** Starts the loaded scene from these places, now and at each reset, pins with it [m]. */
  startFrom(places: Float64Array): string;
  reset(): string;
  /** 0, or the status code whose reason `status()` tells. */
  step(count: number): number;
  status(): string;
  numbers(): string;
  /** Views of module memory: a view is dead after the next call, take it anew each time. */
  positions(): Float32Array;
  /** Positions in full precision. */
  exactPositions(): Float64Array;
  /** One a vertex [kg]. */
  masses(): Float64Array;
  /** Signed mean strain of the springs at each vertex, as a ratio. */
  stretch(): Float32Array;
  /** Distance to the reference at each vertex [m]; empty without one for the scene at its time. */
  distances(): Float32Array;
  triangles(): Uint32Array;
  /** Accounts for energy from now on, and anew from each start and load, until it is closed. */
  openLedger(): void;
  closeLedger(): void;
  /** ENERGY_NUMBERS; empty while there is no account. */
  energies(): Float64Array;
  /** The two parts of a SpringSplit. */
  springEnds(): Uint32Array;
  implicitSprings(): Int8Array;
  /** An ImexShare, when imex is given so many substeps of a step [s] and a least share of explicit springs. */
  implicitShare(stepS: number, substeps: number, explicitShare: number): string;
  /**
   * Makes levels coarser than the mesh, which are there until the mesh is another one: `n_coarser` of
   * them, and the `shortage` of MeshLevels.
   */
  makeLevels(selection: LevelSelection, nCoarser: number, ratio: number): string;
  /** The two parts of a MeshLevel; 0 is the mesh. */
  levelVertices(level: number): Uint32Array;
  levelEdges(level: number): Uint32Array;
  /** Compares with a reference from now on, whenever the loaded scene is what it is of. */
  setReference(bytes: Uint8Array): string;
  /** Solids where they are now; a mesh by its offset [m] and its number among `surfaces`. */
  colliders(): string;
  surfaces(): string;
  grab(vertex: number): string;
  /** Target of the held patch [m]. */
  moveGrab(x: number, y: number, z: number): void;
  releaseGrab(): void;
  delete(): void;
}

export interface PleatModule {
  Scene: new (fabricsText: string) => SceneHandle;
  Simulation: new (fabricsText: string) => SimulationHandle;
}
