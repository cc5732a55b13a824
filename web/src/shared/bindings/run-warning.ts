/** What a run shows that its scene cannot explain (docs/methods/plausibility.md). */
export interface RunWarning {
  kind: 'stretch' | 'speed' | 'unsolved';
  /** When it was first seen. */
  time_s: number;
  vertex: number;
  sentence: string;
  /** Values that may help, by their JSON pointers into the scene. */
  hints: Record<string, number>;
}

export function warningSentence({ sentence }: RunWarning): string {
  return `This is not how cloth moves: ${sentence}.`;
}
