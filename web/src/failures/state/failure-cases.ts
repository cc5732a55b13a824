// Hard cases that are seen to break: the same scene by a naive method and by one that holds, and the sign
// that the naive one shows. A test runs each of them.
import contradictingPinsText from '../../../../assets/hard_cases/contradicting_pins.json?raw';
import fastGrooveText from '../../../../assets/hard_cases/fast_groove.json?raw';
import heavyBeadText from '../../../../assets/hard_cases/heavy_bead.json?raw';
import hundredfoldText from '../../../../assets/hard_cases/hundredfold_stiffness.json?raw';
import longStepText from '../../../../assets/hard_cases/long_step_stiff_cloth.json?raw';
import needleCellsText from '../../../../assets/hard_cases/needle_cells.json?raw';
import restOnABallText from '../../../../assets/hard_cases/rest_on_a_ball.json?raw';
import scaleOfADrapeText from '../../../../assets/hard_cases/scale_of_a_drape.json?raw';
import tumblingText from '../../../../assets/hard_cases/tumbling.json?raw';
import type { RunWarning } from '../../shared/bindings/run-warning';

export const SIDES = ['naive', 'ours'] as const;
export type Side = (typeof SIDES)[number];

/** A sign that a run is no cloth any more: a warning, or that it had to end. */
export type Sign = RunWarning['kind'] | 'ended';

interface Contestant {
  words: string;
  method: Record<string, unknown>;
}

export interface FailureCase extends Record<Side, Contestant> {
  /** Name of its scene in assets/hard_cases, as it stands in links and after `./pleat hard-cases`. */
  id: string;
  title: string;
  /** The thing that breaks, and why. */
  lesson: string;
  /** The method that holds it. */
  remedy: string;
  sceneText: string;
  /** Signs that the naive side shows; ours shows none. */
  sign: Sign;
  /** How much of it is played [s]. */
  endS: number;
  /** It flies off: the picture goes with ours. */
  isFollowed?: true;
}

export const STEP_S = 1 / 60;

const IMPLICIT: Contestant = { words: 'Implicit, one substep', method: { stepper: 'implicit' } };

const POSITION_BASED: Contestant = {
  words: 'Position-based, 4 substeps',
  method: { stepper: 'xpbd', substeps: 4 },
};

const FINE_POSITION_BASED: Contestant = {
  words: 'Position-based, 30 substeps',
  method: { stepper: 'xpbd', substeps: 30 },
};

export const CASES: readonly FailureCase[] = [
  {
    id: 'long_step_stiff_cloth',
    title: 'A step too long',
    lesson:
      'An explicit step lets a spring pull as hard as it did when the step began. Where that carries the cloth beyond the spring’s rest, the next step pulls back harder still.',
    remedy: 'Implicit steps solve for the forces at their end. One step a picture is enough.',
    sceneText: longStepText,
    naive: {
      words: 'Explicit, 400 substeps where 734 are stable',
      method: { stepper: 'explicit', substeps: 400, beyond_bound: 'go_on' },
    },
    ours: IMPLICIT,
    sign: 'speed',
    endS: 2,
  },
  {
    id: 'tumbling',
    title: 'Energy from nothing',
    lesson:
      'Forward Euler moves along the velocity that was. On a circle that is always a little outwards: cloth that turns in free space speeds up and flies apart.',
    remedy: 'The Runge–Kutta method of fourth order keeps the energy to its fifth digit and more.',
    sceneText: tumblingText,
    naive: {
      words: 'Forward Euler, 100 substeps',
      method: { stepper: 'explicit', euler: 'forward', substeps: 100, beyond_bound: 'go_on' },
    },
    ours: { words: 'Runge–Kutta, 8 substeps', method: { stepper: 'rk4', substeps: 8 } },
    sign: 'stretch',
    endS: 2,
    isFollowed: true,
  },
  {
    id: 'needle_cells',
    title: 'Two hundred rows',
    lesson:
      'Projected one line after the other, a pull goes only a few rows far in a substep. The lower rows of a long cloth fall as if nothing held them.',
    remedy:
      'One system of equations for all rows carries the pull through the whole cloth at once.',
    sceneText: needleCellsText,
    naive: POSITION_BASED,
    ours: IMPLICIT,
    sign: 'stretch',
    endS: 1,
  },
  {
    id: 'hundredfold_stiffness',
    title: 'A hundred times as stiff',
    lesson:
      'The stiffer the springs, the shorter a stable explicit step. At a hundred times a fabric’s stiffness, 400 substeps a picture end in numbers without end, within the first step.',
    remedy: 'Position-based substeps have no such bound: stiffness is a compliance near nothing.',
    sceneText: hundredfoldText,
    naive: {
      words: 'Explicit, 400 substeps',
      method: { stepper: 'explicit', substeps: 400, beyond_bound: 'go_on' },
    },
    ours: FINE_POSITION_BASED,
    sign: 'ended',
    endS: 2,
  },
  {
    id: 'scale_of_a_drape',
    title: 'Two rounds',
    lesson:
      'Projective dynamics solves its equations in rounds. After two of them much is left unsolved: what meets a ball lags behind its own weight, and looks well while it does.',
    remedy: 'Ten rounds with the same factor.',
    sceneText: scaleOfADrapeText,
    naive: {
      words: 'Projective, 2 rounds',
      method: { stepper: 'projective', substeps: 1, iterations: 2 },
    },
    ours: {
      words: 'Projective, 10 rounds',
      method: { stepper: 'projective', substeps: 1, iterations: 10 },
    },
    sign: 'unsolved',
    endS: 2,
  },
  {
    id: 'rest_on_a_ball',
    title: 'Put back on a ball',
    lesson:
      'Contact puts back each vertex that went into the ball, after the springs were solved. In one long substep what hangs beside it pulls the cloth out like rubber.',
    remedy: 'Touched cloth is held inside the solve, so that springs know what they hang from.',
    sceneText: restOnABallText,
    naive: {
      words: 'Position-based, one substep',
      method: { stepper: 'xpbd', substeps: 1 },
    },
    ours: IMPLICIT,
    sign: 'stretch',
    endS: 2,
  },
  {
    id: 'fast_groove',
    title: 'Thrown at 50 m/s',
    lesson:
      'Within a sixtieth of a second the cloth flies most of a metre, into the groove between two balls and a wall. What hits a ball stops, what misses it flies on: one step tears it to several times its length.',
    remedy: 'Short substeps where the motion is fast: 30 a picture, at about the cost of the one.',
    sceneText: fastGrooveText,
    naive: { words: 'Implicit, one substep', method: { stepper: 'implicit', substeps: 1 } },
    ours: { words: 'Position-based, 30 substeps', method: { stepper: 'xpbd', substeps: 30 } },
    sign: 'stretch',
    endS: 0.3,
  },
  {
    id: 'contradicting_pins',
    title: 'Pulled to twice its width',
    lesson:
      'Two corners of a square are pulled apart, until they are twice its width from each other. Springs that are projected in turn pass on little of such a pull in a substep: those beside the corners take it, and stretch to more than three times their length.',
    remedy:
      'Implicit steps find where the forces balance: the whole edge, and the cloth below it, share the pull.',
    sceneText: contradictingPinsText,
    naive: FINE_POSITION_BASED,
    ours: IMPLICIT,
    sign: 'stretch',
    endS: 1,
  },
  {
    id: 'heavy_bead',
    title: 'A bead on a net',
    lesson:
      'One particle weighs ten thousand times what its neighbours do. Projected in turn, each light neighbour gives way before the heavy one moves at all.',
    remedy: 'In one system of equations the bead’s mass is no harder than any other.',
    sceneText: heavyBeadText,
    naive: POSITION_BASED,
    ours: IMPLICIT,
    sign: 'unsolved',
    endS: 2,
  },
];

export function caseNamed(id: string): FailureCase {
  const found = CASES.find((one) => one.id === id);
  if (!found) throw new Error(`there is no case "${id}"`);
  return found;
}

/** The case's scene with the method of one side. */
export function sceneTextOf(one: FailureCase, side: Side): string {
  const scene = JSON.parse(one.sceneText) as object;
  return JSON.stringify({ ...scene, method: { step_s: STEP_S, ...one[side].method } });
}
