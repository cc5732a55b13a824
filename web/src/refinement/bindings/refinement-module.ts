// The classes bound by the WebAssembly module of garments, and the shape of the texts it answers with.
import type { Triple } from '../../shared/bindings/geometry';
import type { RunWarning } from '../../shared/bindings/run-warning';

/** The answer of `GarmentRun.load`. */
export interface GarmentSummary {
  name: string;
  caption: string;
  fabric: string;
  n_vertices: number;
  /** Faces that are not split. */
  n_faces: number;
  n_base_faces: number;
  n_hanging: number;
  step_s: number;
  duration_s: number;
  /** Its plan has limits, so `look` can tell whether the motion fits. */
  has_monitor: boolean;
}

/** Wall time since the last load or reset, the first step not counted. */
export interface GarmentCosts {
  parts_ms: Record<string, number>;
  steps_ms: number;
  steps_timed: number;
}

/** Warnings, at most one of each kind since the last load or reset. */
export interface WarningsAnswer {
  warnings: RunWarning[];
}

/** How a motion fits a plan's example. */
export interface FitAnswer {
  /** Share of the faces that bend beyond what those near them did in the examples. */
  share: number;
  worst_share: number;
  /** Frames up to this one with too large a share. */
  n_in_a_row: number;
  n_frames: number;
  fires: boolean;
  /** Counted from 0. */
  first_fired: number | null;
}

/** Comparison with a shape of the fine mesh. */
export interface ComparedAnswer {
  /** Distance between equal points of the cloth. */
  rms_m: number;
  /** Loss of this mesh of the shape by its faces alone, and of the normals. */
  lost_m: number;
  lost_normals_rad: number;
}

export interface FaultsAnswer {
  /** Vertices inside of the body's solids, and the deepest of them [m]. */
  n_inside: number;
  deepest_m: number;
  /** Edges that go through faces of the same cloth. */
  n_crossings: number;
}

/** The hull of two balls, widened across its axis. */
export interface RoundedCone {
  a_m: Triple;
  b_m: Triple;
  radius_a_m: number;
  radius_b_m: number;
  across: Triple;
  half_width_a_m: number;
  half_width_b_m: number;
}

export interface SolidsAnswer {
  cones: RoundedCone[];
  pelvis_m: Triple | null;
}

/** The text of each file that a scene names, by that name. */
export type HandedFiles = Record<string, string>;

/** Cloth of quads in motion on one of its meshes. Views are dead after the next call. */
export interface GarmentRunHandle {
  load(sceneText: string, files: HandedFiles): string;
  reset(): string;
  /** 0, or the status code whose reason `status()` tells. */
  step(count: number): number;
  /** Shows a frame from elsewhere. */
  put(places: Float32Array, timeS: number): string;
  /** Takes what frames are held against from now on: a scene of the same cloth on its fine mesh. */
  holdAgainst(sceneText: string, files: HandedFiles): string;
  /** Shows what this mesh could show of a shape of the fine one. */
  putSample(finePlaces: Float32Array, timeS: number): string;
  status(): string;
  costs(): string;
  /** A WarningsAnswer. */
  warnings(): string;
  /** The monitor sees the shown frame. */
  addShownFrame(): string;
  /** A ComparedAnswer; fills `distances`. */
  compare(finePlaces: Float32Array): string;
  /** `rms_m` between both surfaces, whatever slid along them. */
  compareSurface(finePlaces: Float32Array): string;
  /** The folds of the shown frame count from now on, until the next reset. */
  addFolds(): string;
  /** How far folds stand out, by their number around each ring, over what was added [m]. */
  folds(): Float64Array;
  /** `distance_m` between `folds` of two runs: how differently they are folded. */
  compareFolds(own: Float64Array, others: Float64Array): string;
  /** A FaultsAnswer of the shown frame. */
  faults(): string;
  solids(): string;
  time(): number;
  positions(): Float32Array;
  triangles(): Uint32Array;
  /** The face that each triangle is of, by its place in `faces`. */
  triangleFaces(): Uint32Array;
  /** The quads' edges as pairs of vertices. */
  edges(): Uint32Array;
  hanging(): Uint32Array;
  /** Seven numbers a face that is not split: itself, level, parent or -1, corners. */
  faces(): Int32Array;
  /** Four numbers a vertex, -1 for none. */
  parents(): Int32Array;
  /** One number a vertex [1/m]. */
  curvature(): Float32Array;
  /** One number a vertex [m]; filled by `compare`. */
  distances(): Float32Array;
  delete(): void;
}

/** Examples of one cloth on its fine mesh, and the plans made of them. */
export interface ExampleStudyHandle {
  open(sceneText: string, files: HandedFiles): string;
  parents(): Int32Array;
  addFrame(places: Float32Array): string;
  /** Mean and deviation of each fine vertex's curvature over the added frames [1/m]. */
  features(): Float64Array;
  /** One example more that plans are made of. */
  sort(name: string, features: ArrayLike<number>, nPatterns: number): string;
  /** `{largest_loss_m}`, `{demand}` (by curvature) or `{max_vertices}`. */
  plan(optionsText: string): string;
  delete(): void;
}

export interface RefinementModule {
  GarmentRun: new (fabricsText: string) => GarmentRunHandle;
  ExampleStudy: new (fabricsText: string) => ExampleStudyHandle;
}
