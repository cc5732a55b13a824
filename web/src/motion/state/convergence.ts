// Methods that are compared on one step, and the result of the last comparison.

import { STEPPERS, stepperRow } from '../../shared/steppers/steppers';
import type {
  Constraints,
  ConvergenceStudy,
  ConvergenceWish,
} from '../bindings/convergence-module';
import { detailOf, methodOf, type Setting, withDetail } from './setting';

/** Solve a whole step at once: how far they are is told where constraints are compliant. */
const WHOLE_STEP = ['implicit', 'projective', 'newton'];

const MOST_ROUNDS = 513;

/** A usual sheet is studied within some ten seconds [s]. */
const LONGEST_SOLVE_S = 0.03;

/** The quicker one of two batches counts: what slowed the other down was not the method. */
const REPEAT = 2;

/** Most vertices: with more it takes a minute to find what compliant constraints come to. */
export const MOST_COMPLIANT_VERTICES = 1500;

/** The time since the start that the step begins at [s]; null: the one that is shown. */
export type StepBegin = number | null;

export interface ComparedMethod {
  title: string;
  /** The visitor's own, beside the usual one of the same stepper. */
  isOwn: boolean;
  method: Record<string, unknown>;
}

export interface ConvergenceResult {
  study: ConvergenceStudy;
  /** One for each series. */
  methods: readonly ComparedMethod[];
  constraints: Constraints;
}

/** `refused`: why the step tells nothing, in a sentence. */
export type ConvergenceStory =
  | 'unasked'
  | { done: number }
  | { refused: string }
  | ConvergenceResult;

export interface ConvergenceState {
  begin: StepBegin;
  /** Null: as the shown method has them. */
  constraints: Constraints | null;
  /** Words on what the story is of. */
  of: string;
  /** The cloth was playing meanwhile, which made its times too long. */
  disturbed: boolean;
  story: ConvergenceStory;
}

/** It moves springs one by one. */
function isPositionBased(stepper: string): boolean {
  const { needs_springs, solves_whole_substeps } = stepperRow(stepper);
  return needs_springs && !solves_whole_substeps;
}

/** Constraints of the shown method; rigid where it has none. */
export function constraintsOf(setting: Setting): Constraints {
  return detailOf(setting, 'constraints') === 'compliant' ? 'compliant' : 'rigid';
}

/** The shown method as it is set, when it is compared at all and is not the usual one. */
function ownMethod(setting: Setting): ComparedMethod | null {
  const { stepper } = setting;
  if (!isPositionBased(stepper)) return null;
  const own = withDetail(setting, 'constraints', stepperRow(stepper).details.constraints);
  if (!own.details) return null;
  return { title: `${stepperRow(stepper).title}, as set`, isOwn: true, method: methodOf(own) };
}

/** Every stepper that can be compared on a step, in the order of the table. */
export function comparedMethods(setting: Setting, constraints: Constraints): ComparedMethod[] {
  const usual = STEPPERS.filter(
    ({ name }) =>
      isPositionBased(name) || (constraints === 'compliant' && WHOLE_STEP.includes(name)),
  ).map(({ name, title }) => ({
    title,
    isOwn: false,
    method:
      name === setting.stepper && !isPositionBased(name) ? methodOf(setting) : { stepper: name },
  }));
  const own = ownMethod(setting);
  return own ? [...usual, own] : usual;
}

export function convergenceWish(
  methods: readonly ComparedMethod[],
  constraints: Constraints,
  timeS: number,
): ConvergenceWish {
  return {
    time_s: timeS,
    constraints,
    most_rounds: MOST_ROUNDS,
    longest_solve_s: LONGEST_SOLVE_S,
    repeat: REPEAT,
    methods: methods.map(({ method }) => method),
  };
}

export const NO_CONVERGENCE: ConvergenceState = {
  begin: null,
  constraints: null,
  of: '',
  disturbed: false,
  story: 'unasked',
};
