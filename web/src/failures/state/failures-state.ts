// State of the view of failures.
import { inputFailure } from '../../shared/bindings/answers';
import type { RunWarning } from '../../shared/bindings/run-warning';
import type { InStepState } from '../../shared/workers/in-step';
import { CASES, SIDES, type Side } from './failure-cases';

export interface SideState {
  warnings: readonly RunWarning[];
  /** Why the run had to end, and when. */
  ended: { sentence: string; timeS: number } | null;
  /** The case's own sign: when it was first seen, and its worst value. */
  measured: { timeS: number; value: number } | null;
  /** Largest |edge strain| since the start, as a ratio. */
  mostStretch: number;
  /** Time of a step, as measured while it ran [ms]. */
  msPerStep: number | null;
}

export interface FailuresState extends InStepState {
  caseId: string;
  sides: Record<Side, SideState>;
  /** The meshes are drawn. */
  edges: boolean;
}

const FRESH: SideState = {
  warnings: [],
  ended: null,
  measured: null,
  mostStretch: 0,
  msPerStep: null,
};

export function freshSides(): Record<Side, SideState> {
  return Object.fromEntries(SIDES.map((side) => [side, FRESH])) as Record<Side, SideState>;
}

export function initialFailuresState(caseId: string, problems: readonly string[]): FailuresState {
  return {
    caseId,
    phase: 'loading',
    playing: false,
    speed: 1,
    timeS: 0,
    sides: freshSides(),
    edges: false,
    problem: problems.length > 0 ? inputFailure(`The link: ${problems.join('; ')}.`) : null,
  };
}

export const FIRST_CASE = CASES[0]?.id ?? '';
