// State of the view of failures.
import type { Failure } from '../../shared/bindings/answers';
import { inputFailure } from '../../shared/bindings/answers';
import type { RunWarning } from '../../shared/bindings/run-warning';
import { CASES, SIDES, type Side } from './failure-cases';

export interface SideState {
  warnings: readonly RunWarning[];
  /** Why the run had to end, and when. */
  ended: { sentence: string; timeS: number } | null;
  /** Largest |edge strain| now, as a ratio. */
  stretch: number;
  /** Time of a step, as measured while it ran [ms]. */
  msPerStep: number | null;
}

export interface FailuresState {
  caseId: string;
  phase: 'loading' | 'ready' | 'stopped' | 'broken';
  playing: boolean;
  speed: number;
  timeS: number;
  sides: Record<Side, SideState>;
  problem: Failure | null;
}

const FRESH: SideState = { warnings: [], ended: null, stretch: 0, msPerStep: null };

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
    problem: problems.length > 0 ? inputFailure(`The link: ${problems.join('; ')}.`) : null,
  };
}

export const FIRST_CASE = CASES[0]?.id ?? '';
