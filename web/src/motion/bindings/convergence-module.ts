// The function bound by the module that compares methods on one step, and what it answers with.

/** State of the step after so many rounds of a method. */
export interface ConvergencePoint {
  rounds: number;
  /** Sweeps of the finest mesh; null of methods that have none. */
  sweeps: number | null;
  ms: number;
  /** Share that is left of the error of the constraints; null of methods that have none. */
  relative_error: number | null;
  /** Share that is left of the distance to what the method's own equations come to; null where that is not known. */
  relative_distance: number | null;
}

export interface ConvergenceSeries {
  /** The method, as the section "method" of a scene. */
  method: { stepper: string; [setting: string]: unknown };
  /** Distance of the predicted places from what the equations come to [m]. */
  distance_begin_m: number | null;
  /** How far what they come to may be off [m]. */
  distance_unknown_m: number | null;
  /** Points by rounds. */
  points: ConvergencePoint[];
}

export interface ConvergenceStudy {
  /** When the step begins. */
  time_s: number;
  step_s: number;
  n_vertices: number;
  n_springs: number;
  n_bends: number;
  /** Series in the order of the methods. */
  series: ConvergenceSeries[];
}

export type Constraints = 'rigid' | 'compliant';

export interface ConvergenceWish {
  time_s: number;
  /** Constraints of position-based methods. */
  constraints: Constraints;
  /** A method gets no more rounds, and none after a solve that took longer. */
  most_rounds: number;
  longest_solve_s: number;
  /** Timed batches of each number of rounds. */
  repeat: number;
  methods: object[];
}

/** A module of its own, fetched when the first step is studied. */
export interface ConvergenceModule {
  /**
   * A `study` of what is wished, a ConvergenceWish as text. `hear` is told how much of it is done,
   * from 0 to 1.
   */
  studyConvergence(
    fabricsText: string,
    sceneText: string,
    wishText: string,
    hear: (done: number) => void,
  ): string;
}
