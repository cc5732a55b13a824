// Goals that every stepper has to reach, of one group of cases and of all that were run.
import { atLeast, atMost, largest } from './bench-rows.mjs';
import { counts } from './same-cloth-runs.mjs';

/** Rows that have been computed. */
const computed = (rows) => rows.filter(({ status }) => status !== undefined);
const off = ({ value, right }) => Math.abs(value - right);
const share = (row) => off(row) / Math.abs(row.right);

function cantileverGoals(rows) {
  const kMost = 3; // degrees
  return ['multigrid', 'projective'].map((stepper) => {
    const its = rows.filter(
      (row) =>
        row.stepper === stepper && row.case.startsWith('cantilever of 2 bending lengths, 5 mm'),
    );
    return atMost(`cantilever_2_lengths_5_mm_${stepper}_degrees`, largest(its.map(off)), kMost);
  });
}

function sagGoals(rows) {
  const others = computed(rows).filter(({ stepper }) => stepper !== 'pbd');
  return [atMost('sag_off_by_share_all_but_pbd', largest(others.map(share)), 0.02)];
}

const terminalGoals = (rows) => [
  atMost('terminal_speed_off_by_share', largest(computed(rows).map(share)), 0.01),
];

function flagGoals(rows) {
  const overBound = ({ value, right, tolerance }) => value / (right + tolerance);
  return [atMost('flag_speed_over_what_air_leaves', largest(computed(rows).map(overBound)), 1)];
}

function swatchGoals(rows) {
  const fine = computed(rows).filter(
    (row) => row.stepper === 'xpbd' && row.case.includes('60 x 60'),
  );
  return [atMost('fine_swatch_largest_stretch_xpbd', largest(fine.map(off)), 0.002)];
}

function ballGoals(rows) {
  const kMost = { '1/240': 0.05, '1/960': 0.01 }; // shares of the way
  return Object.entries(kMost).flatMap(([step, most]) => {
    const its = computed(rows).filter((row) => row.case.includes(`, ${step} s`));
    if (its.length === 0) return [];
    const [name] = its[0].case.split(' ');
    return [atMost(`off_a_ball_${name}_${step.slice(2)}_per_s`, largest(its.map(off)), most)];
  });
}

const kGoals = {
  cantilever: cantileverGoals,
  sag: sagGoals,
  terminal: terminalGoals,
  flag: flagGoals,
  swatch: swatchGoals,
  bead: ballGoals,
  ball: ballGoals,
  large_ball: ballGoals,
};

export const groupGoals = (group, rows) => kGoals[group]?.(rows) ?? [];

const kLeastShares = {
  implicit: 1,
  imex: 1,
  newton: 1,
  projective: 0.9,
  multigrid: 0.9,
  xpbd: 0.75,
  pbd: 0.75,
  hpbd: 0.75,
};
const kQuietGroups = ['terminal', 'incline', 'slide']; // free fall, slopes, rest

/** Goals over the rows of all groups that were run. */
export function overallGoals(rows) {
  const wrong = rows.filter(({ verdict }) => verdict === 'WRONG').length;
  const alarms = rows.filter(
    ({ group, verdict, told }) =>
      kQuietGroups.includes(group) && verdict === 'ok' && told.length > 0,
  ).length;
  return [
    atMost('silent_wrong_rows', wrong, 0),
    ...Object.entries(kLeastShares).map(([stepper, least]) =>
      atLeast(`right_rows_share_${stepper}`, counts(rows, stepper).share, least),
    ),
    atMost('false_alarms_of_what_falls_slides_and_rests', alarms, 0),
  ];
}
