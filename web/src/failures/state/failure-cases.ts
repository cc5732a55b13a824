// Failures that are seen within two seconds: one scene by a naive method and by one that holds, and the sign that the
// naive one shows. A test runs each of them, and holds the words to what it finds.
import type { RunWarning } from '../../shared/bindings/run-warning';
// Node reads this file for a bench as well: that wants the ending of the name.
import {
  BEAD,
  CELLS,
  CURTAIN,
  DRAPE,
  FLAG,
  GROOVE,
  RUSHING_BALL,
  type Scene,
  SOFT_SWING,
  STIFF_SWING,
  TUMBLING,
} from './failure-scenes.ts';

export const SIDES = ['naive', 'ours'] as const;
export type Side = (typeof SIDES)[number];

/** A sign that a run is no cloth any more: a warning, that it had to end, or what is measured of its shape. */
export type Sign = RunWarning['kind'] | 'ended' | 'measured';

/** A failure that no warning tells. */
export interface Measure {
  title: string;
  /** A number of the shape at a time [s], from its positions, three numbers a vertex [m]. */
  of(positions: ArrayLike<number>, timeS: number): number;
  /** The most that is no failure. */
  bound: number;
  /** The sentence for the worst value. */
  sentence(value: number): string;
}

interface Contestant {
  words: string;
  method: Record<string, unknown>;
}

export interface FailureCase extends Record<Side, Contestant> {
  /** Its name in links and files. */
  id: string;
  title: string;
  /** The thing that breaks, and why. */
  lesson: string;
  /** The method that holds it. */
  remedy: string;
  scene: Scene;
  /** Signs that the naive side shows; ours shows none. */
  sign: Sign;
  measure?: Measure;
  /** How much of it is played [s], and how fast it is shown at first. */
  endS: number;
  speed?: number;
  /** It flies off: the picture goes with ours. */
  isFollowed?: true;
}

export const STEP_S = 1 / 60;

const IMPLICIT: Contestant = { words: 'Implicit, one substep', method: { stepper: 'implicit' } };

const IN_30_SUBSTEPS: Contestant = {
  words: 'Position-based, 30 substeps',
  method: { stepper: 'xpbd', substeps: 30 },
};

const IN_ONE_SUBSTEP: Contestant = {
  words: 'Position-based, one substep',
  method: { stepper: 'xpbd', substeps: 1 },
};

const BY_ROUNDS: Contestant = {
  words: 'Projective, 10 rounds',
  method: { stepper: 'projective', iterations: 10 },
};

const BY_LEVELS: Contestant = {
  words: 'Multigrid, 10 substeps',
  method: { stepper: 'multigrid', substeps: 10 },
};

/** Time within which a pendulum of a metre has swung down [s]. */
const SWUNG_S = 1;

/** How far the free edge of a level sheet has come down, with its sign turned [m]; nothing of interest before. */
function minusFall(positions: ArrayLike<number>, timeS: number): number {
  if (timeS < SWUNG_S) return Number.NEGATIVE_INFINITY;
  const width = CELLS + 1;
  let sum = 0;
  for (let vertex = positions.length / 3 - width; vertex < positions.length / 3; ++vertex)
    sum += (positions[3 * vertex + 1] ?? 0) - (positions[1] ?? 0);
  return sum / width;
}

export const CASES: readonly FailureCase[] = [
  {
    id: 'gathered_curtain',
    title: 'A pull that comes too late',
    lesson:
      'Projected one line after the other, a pull goes only a few rows far in a step. The lower rows of a curtain fall as if nothing held them: it stretches by more than 80 %, like rubber.',
    remedy:
      'Coarser levels of the mesh carry a pull through the whole cloth at once. It stretches by 1 %.',
    scene: CURTAIN,
    naive: { words: 'Position-based, 4 sweeps', method: { stepper: 'pbd', iterations: 4 } },
    ours: BY_LEVELS,
    sign: 'stretch',
    endS: 2,
  },
  {
    id: 'long_step',
    title: 'A step too long',
    lesson:
      'An explicit step lets a spring pull as hard as it did when the step began. Where that carries the cloth beyond the spring’s rest, the next step pulls back harder still. A tenth of a second later it is faster than 100 m/s, and then beyond all numbers.',
    remedy: 'Implicit steps solve for the forces at their end. One step a picture is enough.',
    scene: SOFT_SWING,
    naive: {
      words: 'Explicit, 10 substeps where 17 are stable',
      method: { stepper: 'explicit', substeps: 10, beyond_bound: 'go_on' },
    },
    ours: IMPLICIT,
    sign: 'speed',
    endS: 2,
  },
  {
    id: 'tumbling',
    title: 'Energy from nothing',
    lesson:
      'Forward Euler moves along the velocity that was. On a circle that is always a little outwards: cloth that turns in free space shivers, speeds up and flies apart.',
    remedy:
      'The Runge–Kutta method of fourth order looks at four places in each step. Four steps a picture do what 26 of Euler’s do not.',
    scene: TUMBLING,
    naive: {
      words: 'Forward Euler, 26 substeps',
      method: { stepper: 'explicit', euler: 'forward', substeps: 26, beyond_bound: 'go_on' },
    },
    ours: { words: 'Runge–Kutta, 4 substeps', method: { stepper: 'rk4', substeps: 4 } },
    sign: 'stretch',
    endS: 1.6,
    isFollowed: true,
  },
  {
    id: 'hundredfold_stiffness',
    title: 'A hundred times as stiff',
    lesson:
      'Projective dynamics solves its equations in rounds, and the stiffer the cloth, the less a round may move it. At a hundred times the stiffness of canvas ten rounds leave it in the air: a second after it was let go its free edge is 3 cm down.',
    remedy:
      'Threads that are rigid anyway, on coarser levels first: there stiffness costs nothing.',
    scene: STIFF_SWING,
    naive: BY_ROUNDS,
    ours: BY_LEVELS,
    sign: 'measured',
    measure: {
      title: 'hangs in the air',
      of: minusFall,
      bound: -0.5,
      sentence: (value) =>
        `A second after it was let go, its free edge is ${Math.round(-100 * value)} cm down. A pendulum of a metre has swung down by then. No warning tells: each step leaves little unsolved, and little done.`,
    },
    endS: 2,
  },
  {
    id: 'stiff_in_one_substep',
    title: 'Spikes',
    lesson:
      'The same cloth, position-based: springs that are corrected in turn undo each other’s work, and one substep ends long before they agree. It stretches to more than ten times its length, faces turn their backs on their neighbours, and spikes stand out.',
    remedy: 'Thirty substeps of a thirtieth of the length: each has little to correct.',
    scene: STIFF_SWING,
    naive: IN_ONE_SUBSTEP,
    ours: IN_30_SUBSTEPS,
    sign: 'stretch',
    endS: 1.4,
  },
  {
    id: 'rest_on_a_ball',
    title: 'Put back on a ball',
    lesson:
      'Contact puts back each vertex that went into the ball, after the springs were solved. In one long substep what hangs beside it pulls the cloth out to twice its length, like rubber.',
    remedy:
      'Touched cloth is held inside the solve, so that springs know what they hang from. It stretches by less than 5 %.',
    scene: DRAPE,
    naive: IN_ONE_SUBSTEP,
    ours: BY_ROUNDS,
    sign: 'stretch',
    endS: 2,
  },
  {
    id: 'rushing_ball',
    title: 'A ball through a curtain',
    lesson:
      'Contact holds vertices, and threads hold vertices together. Ten sweeps are too few for these threads: those around the ball open to more than six times their length, and it is through.',
    remedy: 'Thirty short substeps: the threads hold, and the curtain goes along with the ball.',
    scene: RUSHING_BALL,
    naive: { words: 'Position-based, 10 sweeps', method: { stepper: 'pbd', iterations: 10 } },
    ours: IN_30_SUBSTEPS,
    sign: 'stretch',
    endS: 2,
  },
  {
    id: 'fast_groove',
    title: 'Thrown at 30 m/s',
    lesson:
      'In a sixtieth of a second the cloth flies half a metre, into the groove between two balls and a wall. What hits a ball stops, what misses it flies on: one step pulls it to more than four times its length.',
    remedy: 'Short substeps where the motion is fast. It stretches by less than a third.',
    scene: GROOVE,
    naive: IN_ONE_SUBSTEP,
    ours: IN_30_SUBSTEPS,
    sign: 'stretch',
    endS: 0.3,
    speed: 0.25,
  },
  {
    id: 'heavy_bead',
    title: 'A bead on a net',
    lesson:
      'One particle weighs 40 000 times what its neighbours do. Projected in turn, each light neighbour gives way before the heavy one moves at all: it falls as if there were no net.',
    remedy:
      'In one system of equations the bead’s mass is no harder than any other. The net holds it.',
    scene: BEAD,
    naive: {
      words: 'Position-based, 4 substeps',
      method: { stepper: 'xpbd', substeps: 4 },
    },
    ours: IMPLICIT,
    sign: 'unsolved',
    endS: 0.6,
    speed: 0.5,
  },
  {
    id: 'flag_in_a_gale',
    title: 'A flag in a gale',
    lesson:
      'Wind of 14 m/s pulls at silk with many times its weight. Ten sweeps carry the pull a few threads far from the pole: there the flag gives way to four times its length.',
    remedy: 'Thirty short substeps hold it: it flutters, and stretches by less than 10 %.',
    scene: FLAG,
    naive: { words: 'Position-based, 10 sweeps', method: { stepper: 'pbd', iterations: 10 } },
    ours: IN_30_SUBSTEPS,
    sign: 'stretch',
    endS: 2,
  },
];

export function caseNamed(id: string): FailureCase {
  const found = CASES.find((one) => one.id === id);
  if (!found) throw new Error(`there is no case "${id}"`);
  return found;
}

/** The case's scene with the method of one side. */
export function sceneTextOf({ id, scene, endS, ...sides }: FailureCase, side: Side): string {
  const method = { step_s: STEP_S, ...sides[side].method };
  return JSON.stringify({ name: id.replaceAll('_', ' '), ...scene, method, duration_s: endS });
}
