/** A sign in a run that its scene cannot explain, or a step that did not converge (docs/methods/plausibility.md). */
export interface RunWarning {
  kind:
    | 'stretch'
    | 'speed'
    | 'unsolved'
    | 'not_converged'
    | 'given_up'
    | 'unbalanced'
    | 'held_back'
    | 'blocked'
    | 'soft';
  /** When it was first seen. */
  time_s: number;
  vertex: number;
  /**
   * Worst value: a strain, a speed [m/s], a share of the equations, of the weight or of the vertices, a count of
   * substeps; null beyond all numbers.
   */
  value: number | null;
  /** Value that the scene explains. */
  bound: number | null;
  sentence: string;
  /** Else the cloth moves as cloth may: a step did not converge, say. */
  is_nonsense: boolean;
  /** Values that may help, by their JSON pointers into the scene: each alone, the best one first. */
  hints: Record<string, unknown>;
}
