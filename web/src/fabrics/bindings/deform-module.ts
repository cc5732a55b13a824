// The class bound by the module that finds shapes, and the shape of the texts it answers with.

/** One number for each term of the energy of a deformed cloth. */
export interface TermNumbers {
  recovery: number;
  stretch: number;
  bending: number;
}

/** Answer of `Deformation.open`: what it finds in an experiment. */
export interface ClothAnswer {
  name: string;
  caption: string;
  n_vertices: number;
  n_triangles: number;
  /** Three numbers a vertex. */
  rest_m: number[];
  /** How far around a vertex a hand holds. */
  grasp_m: number;
  groups: { name: string; vertices: number[] }[];
  /** Held where they rest. */
  pins: number[];
  handles: { name: string; vertices: number[]; places_m: number[] }[];
  fabric: string;
  /** Skipped statements of the OBJ file, counted, in words; missing or empty when none was. */
  skipped?: string;
}

/** How a pane's shape came about and what it costs. */
export interface DeformReport {
  weights: TermNumbers;
  energy: number;
  /** Unweighted. */
  terms: TermNumbers;
  converged: boolean;
  /** Steps since something was last moved, held or weighted otherwise. */
  steps: { energy: number; terms: TermNumbers; relative_step: number; linearised: boolean }[];
}

/** Weights that the measured fabrics make likely for a visitor's own measurements. */
export interface FitAnswer {
  weights: TermNumbers;
  normalised: TermNumbers;
  /** RMS, in normalised measures. */
  leave_one_out_error: TermNumbers;
  measured_range: Record<keyof TermNumbers, [number, number]>;
  /** Measures outside the measured range, which were clamped to it. */
  clamped: (keyof TermNumbers)[];
  nearest: string;
}

/** Answer of `Deformation.step`. */
export const PROGRESS = { moved: 0, ended: 1 } as const;

/**
 * Answer of `Deformation.settle`. Between the ways the first is at its end and the next step goes
 * back to rest; the shapes on the way from there count for nothing.
 */
export const WAY = { fromHere: 0, between: 1, fromRest: 2, done: 3 } as const;

/** One cloth in several panes, each with weights of its own, all under the same hold. */
export interface DeformationHandle {
  /** The cloth of an experiment; `objText` is of the file that it names, or empty. */
  open(sceneText: string, objText: string): string;
  /** `{form, weights: [...]}`: a pane for each. Panes keep their shape while the form stays. */
  show(panesText: string): string;
  /** Vertices, ascending, and three numbers a place [m]. Each pane takes it up in `follow`. */
  hold(vertices: Int32Array, places: Float64Array): string;
  moveHeld(places: Float64Array): void;
  follow(pane: number): string;
  /** A step after the hand, with the factor at hand; one of PROGRESS. */
  step(pane: number): number;
  restart(pane: number): string;
  /** The pane is to find its least energy, if wanted from rest as well; `follow` and `show` end it. */
  beginSettling(pane: number, triesRest: boolean): string;
  /** A step towards it; one of WAY. */
  settle(pane: number): number;
  report(pane: number): string;
  fitMeasures(measuresText: string): string;
  /** The section "cloth" of a scene in motion, with what is held as the group "held". */
  clothSection(): string;
  /** Views of module memory, dead after the next call. */
  triangles(): Uint32Array;
  positions(pane: number): Float32Array;
  /** Ends `settle`. */
  exactPositions(pane: number): Float64Array;
  delete(): void;
}

/** A module of its own, fetched when fabrics are first compared. */
export interface DeformModule {
  Deformation: new (fabricsText: string) => DeformationHandle;
}
