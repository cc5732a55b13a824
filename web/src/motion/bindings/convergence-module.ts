// The function bound by the module that compares methods on one step, and what it answers with.

/** What so many rounds of a method make of the step. */
export interface ConvergencePoint {
  rounds: number;
  /** Sweeps of the finest mesh; null of methods that have none. */
  sweeps: number | null;
  ms: number;
  /** What is left of the error of the constraints; null of methods that have none. */
  relative_error: number | null;
  /** What is left of the distance to what the method's own equations come to; null where that is not known. */
  relative_distance: number | null;
}

export interface ConvergenceSeries {
  /** As the section "method" of a scene. */
  method: { stepper: string; [setting: string]: unknown };
  /** Of the predicted places from what the equations come to [m]. */
  distance_begin_m: number | null;
  /** How far what they come to may be off [m]. */
  distance_unknown_m: number | null;
  /** By rounds. */
  points: ConvergencePoint[];
}

export interface ConvergenceStudy {
  /** When the step begins. */
  time_s: number;
  step_s: number;
  n_vertices: number;
  n_springs: number;
  n_bends: number;
  /** In the order of the methods. */
  series: ConvergenceSeries[];
}

export type Constraints = 'rigid' | 'compliant';

export interface ConvergenceWish {
  time_s: number;
  /** Of position-based methods. */
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
