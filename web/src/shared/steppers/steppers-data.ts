// The steppers, one row each, in the order in which they are offered. The types are in steppers.ts.

/** What steppers have that are stable in small substeps only. */
const STABLE_SUBSTEPS = {
  start: 0,
  least: 0,
  meaning: '0: as many as its stability bound asks for.',
};

/** What steppers have that solve for a whole substep at once. */
const DAMPED_SUBSTEPS = { start: 1, least: 1, meaning: 'More substeps damp less and cost more.' };

export default [
  {
    name: 'implicit',
    title: 'Implicit',
    meaning:
      'Backward Euler: one large sparse system a substep. Stable at large steps, but it damps the motion.',
    needs_springs: false,
    solves: true,
    settings: { substeps: DAMPED_SUBSTEPS },
    sweep: [{ substeps: 1 }, { substeps: 4 }],
    models: ['springs', 'membrane'],
    mark: 'M-4.5 0a4.5 4.5 0 1 0 9 0a4.5 4.5 0 1 0 -9 0Z',
    colour: '#17638f',
    dark_colour: '#7cc3f0',
  },
  {
    name: 'projective',
    title: 'Projective',
    meaning: 'Gives each spring its length alone, then solves one constant system; and repeats.',
    needs_springs: true,
    solves: true,
    settings: {
      substeps: { start: 1, least: 1, meaning: 'More substeps damp less.' },
      iterations: { start: 10, least: 1, meaning: 'More rounds come closer to Implicit.' },
    },
    sweep: [
      { substeps: 1, iterations: 5 },
      { substeps: 1, iterations: 30 },
    ],
    models: ['springs'],
    mark: 'M-4.2-4.2H4.2V4.2H-4.2Z',
    colour: '#a34d00',
    dark_colour: '#f2a35e',
  },
  {
    name: 'xpbd',
    title: 'XPBD',
    meaning: 'Moves the two ends of each spring in turn, in many small substeps.',
    needs_springs: true,
    solves: true,
    settings: {
      substeps: { start: 30, least: 1, meaning: 'More substeps: stiffer and less damped.' },
      iterations: { start: 1, least: 1, meaning: 'Sweeps over all springs in one substep.' },
    },
    sweep: [
      { substeps: 10, iterations: 1 },
      { substeps: 60, iterations: 1 },
    ],
    models: ['springs'],
    mark: 'M0-5.4L5 3.8H-5Z',
    colour: '#4f6f00',
    dark_colour: '#b3d15a',
  },
  {
    name: 'explicit',
    title: 'Explicit',
    meaning: 'Forces give velocities, velocities give positions. Only stable in tiny substeps.',
    needs_springs: false,
    solves: false,
    settings: { substeps: STABLE_SUBSTEPS },
    sweep: [{ substeps: 'stable' }],
    models: ['springs'],
    // Each level has four times the vertices and asks for four times the substeps: the six runs of
    // fine cotton take half a minute at level 1, about ten minutes at level 2.
    finest_sweep_level: 1,
    mark: 'M0-5.6L5.6 0L0 5.6L-5.6 0Z',
    colour: '#8e2a6b',
    dark_colour: '#ee92cd',
  },
  {
    name: 'rk4',
    title: 'Runge-Kutta 4',
    meaning: 'Explicit: evaluates the forces four times a substep. Very exact, and slow.',
    needs_springs: false,
    solves: false,
    settings: { substeps: STABLE_SUBSTEPS },
    sweep: [],
    models: [],
    mark: 'M-5-3.4H5L0 5.2Z',
    colour: '#6a4fa3',
    dark_colour: '#bba6f0',
  },
  {
    name: 'newton',
    title: 'Newton (exact, slow)',
    meaning:
      'Backward Euler, solved to rounding: what is left of its error is due to the length of its steps.',
    needs_springs: false,
    solves: true,
    settings: { substeps: DAMPED_SUBSTEPS },
    sweep: [{ substeps: 1 }],
    models: ['membrane'],
    mark: 'M-1.7-5H1.7V-1.7H5V1.7H1.7V5H-1.7V1.7H-5V-1.7H-1.7Z',
    colour: '#1b2024',
    dark_colour: '#e9e6e0',
  },
];
