// The class bound by the module that measures, and the shape of the texts it answers with.
import type { RunWarning } from '../../shared/bindings/run-warning';

export interface BenchMethod {
  stepper: string;
  step_s: number;
  /** "stable": as many as the stability bound asks for. */
  substeps?: number | 'stable';
  iterations?: number;
  [setting: string]: unknown;
}

/** One measured setting; a number that could not be measured is null. */
export interface BenchRow {
  scene: string;
  /** Its changes to the plan's scene: values by their JSON pointers. */
  setting: Record<string, unknown>;
  method: BenchMethod;
  level: number;
  n_vertices: number;
  /** Substeps of a step, as run. */
  n_substeps: number;
  /** How often solids left a vertex no place outside of them. */
  n_unresolved_contacts: number;
  /** Timed runs, of which the times are the median. */
  n_runs: number;
  /** Wall time of 1/60 s of motion. */
  ms_per_frame: number | null;
  ms_per_simulated_second: number | null;
  /** Slowest minus quickest run, of `ms_per_frame`. */
  spread_ms: number | null;
  position_error_m: number | null;
  /** Percent of the diagonal at rest. */
  position_error_percent: number | null;
  /** Part of `position_error_m` that its method does wrong, against the exact motion of its own mesh. */
  method_error_m: number | null;
  /** Part that its mesh does wrong: how far that motion is from the reference. */
  mesh_error_m: number | null;
  rms_stretch: number | null;
  largest_stretch: number | null;
  /** `uncertainty_m`: errors of less than four times as much are not told. */
  reference: { id: string; converged: boolean; description: string; uncertainty_m: number | null };
  /** "ok", "not_converged" (it ran to its end), or why it failed. */
  status: string;
  message: string;
  /** Warnings of its run, nonsense first; a row of nonsense is on no front. */
  warnings?: RunWarning[];
  target: 'wasm' | 'native';
  [detail: string]: unknown;
}

export interface SweepReport {
  done: boolean;
  /** 0 to 1. */
  progress: number;
  rows: BenchRow[];
  /** Indices into `rows`. */
  front: number[];
  message: string;
  /** Time that the whole sweep is expected to take [s]; null while nothing tells. */
  estimated_s: number | null;
}

export interface ExperimentHandle {
  /** Answers with the ids of the `references` that rows are compared with. */
  start(planText: string): string;
  /** The bytes of a reference's file, which is then not computed. */
  keepReference(bytes: Uint8Array): string;
  advance(budgetMs: number): string;
  delete(): void;
}

/** A module of its own, fetched when the first sweep is asked for. */
export interface SweepModule {
  Experiment: new (fabricsText: string) => ExperimentHandle;
}
