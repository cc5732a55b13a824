// ./pleat bench imex (--help tells the options)
// What it saves to treat only those springs implicitly that need it, and where it does not pay.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

import { commit, described, runParts, tell } from './parts/bench-parts.mjs';
import { exponent, goal, markdown, measure, short } from './parts/bench-rows.mjs';
import { ask, reference, root } from './parts/command.mjs';
import { contestant } from './parts/contestants.mjs';
import { squareSheet } from './parts/square-sheet.mjs';

const kFrames = 100;
const kStep = 1 / 60; // [s]
const kSubsteps = 7; // of 2.4 ms
const kTolerance = 1e-4;

const kImplicit = { stepper: 'implicit', substeps: kSubsteps, solver: 'cg', tolerance: kTolerance };
const kImex = { stepper: 'imex', substeps: kSubsteps, solver: 'sor', tolerance: kTolerance };

/**
 * A sheet of 0.2 kg/m^2, n x n particles on a square with sides of `size` [m], let go from the
 * horizontal, two corners held.
 */
function pendulum(n, method, { fabric = 'fine cotton', size = 1 } = {}) {
  return {
    name: `pendulum ${n}x${n} over ${size} m, ${fabric}`,
    cloth: squareSheet(n, [0, 1.5, 0], [1, 0, 0], [0, 0, 1], size),
    fabric: {
      name: fabric,
      overrides: { damping_ratio: 0.02, areal_density_kg_per_m2: 0.2 },
    },
    pins: [{ part: 'upper_left' }, { part: 'lower_left' }],
    method: { step_s: kStep, ...method },
    duration_s: kFrames * kStep,
  };
}

/** A shipped scene as springs with quadratic bending, which `imex` splits. */
function shipped(file, method, changes = {}) {
  const scene = JSON.parse(readFileSync(join(root, 'assets', 'scenes', `${file}.json`), 'utf8'));
  return { ...scene, ...changes, method: { step_s: kStep, ...method } };
}

/** A skirt on a walking figure; a file of its own finds the motion nowhere else. */
function skirt(method) {
  const motion = join(root, 'assets', 'motions', 'walk_normal.json');
  const figure = { build: 'slim', motion };
  return shipped(join('garments', 'skirt_walk'), method, { figure, refinement: { level: 0 } });
}

/**
 * The scene by several methods in turn, against `newton` with `exactSteps` of a frame.
 *
 * sceneOf: method => scene; methods: {label: method}
 */
function compared(settings) {
  const { repeat, sceneOf, methods, vertices, frames = kFrames, exactSteps = 64 } = settings;
  const times = [(frames * kStep) / 2, frames * kStep];
  const scene = sceneOf({});
  tell(`reference of ${scene.name}`);
  const exact = { stepper: 'newton', step_s: kStep / exactSteps };
  const against = reference(sceneOf(exact), 'run', times);
  const contestants = Object.entries(methods).map(([label, method]) =>
    contestant('native', label, sceneOf(method), vertices, frames),
  );
  return measure(contestants, { repeat, times, commit, tell, against, frames, turnFrames: 5 });
}

const lastError = (row) => Object.values(row.position_errors_m).at(-1);

/** Time and error over those of the first row. */
const overFirst = (rows) =>
  rows.map((row) => ({
    time: row.times_as_long_as_first,
    error: lastError(row) / lastError(rows[0]),
  }));

async function onPendulum({ repeat }) {
  const rows = await compared({
    repeat,
    sceneOf: (method) => pendulum(10, method),
    vertices: 100,
    methods: {
      'implicit, cg': kImplicit,
      'imex, sor': kImex,
      'imex, cg': { ...kImex, solver: 'cg' },
      'imex, cholmod': { stepper: 'imex', substeps: kSubsteps, solver: 'cholmod' },
      'imex_fixed, sor': { ...kImex, split: 'structural' },
      'rk4, largest stable step': { stepper: 'rk4', substeps: 'stable' },
    },
  });
  const [, imex] = overFirst(rows);
  const judged = rows.slice(0, 2);
  return {
    rows,
    goals: [
      goal('imex_sor_time_to_implicit_cg', imex.time, 'at-most', 0.6, judged),
      goal('imex_sor_error_to_implicit_cg', imex.error, 'at-most', 1, judged),
    ],
  };
}

const kGrowing = {
  'imex, sor': kImex,
  'imex, cg': { ...kImex, solver: 'cg' },
  'imex, supernodal': { stepper: 'imex', substeps: kSubsteps, solver: 'supernodal' },
  'implicit, cg': kImplicit,
};

/** How the time of a frame grows with the vertices of n x n particles over sizeOf(n) [m]. */
async function grown(name, repeat, sizeOf) {
  const kSides = [10, 20, 40, 80];
  const rows = [];
  for (const n of kSides) {
    const found = await compared({
      repeat,
      sceneOf: (method) => pendulum(n, method, { size: sizeOf(n) }),
      vertices: n * n,
      frames: 15,
      exactSteps: 8,
      methods: kGrowing,
    });
    rows.push(...found);
  }
  const slope = (label) => {
    const own = rows.filter((row) => row.label.endsWith(label));
    return exponent(own.map((row) => [row.n_vertices, row.ms_per_frame]));
  };
  return {
    rows,
    goals: ['imex, sor', 'imex, cg'].map((label) =>
      goal(`growth_${name}_${label.replace(', ', '_')}`, slope(label), 'at-most', 1.2, rows),
    ),
  };
}

/** A larger cloth with the same mesh width: each particle's springs and mass stay as they are. */
const larger = ({ repeat }) => grown('larger', repeat, (n) => (n - 1) / 9);

/** The same cloth on a finer mesh: what a substep reaches is ever more cells away. */
const finer = ({ repeat }) => grown('finer', repeat, () => 1);

/** The preset's wool with another method, let go or thrown. */
function wool(method, velocity) {
  const scene = JSON.parse(readFileSync(join(root, 'assets', 'scenes', 'wool.json'), 'utf8'));
  const cloth = { knit: { ...scene.cloth.knit, initial_velocity_m_per_s: velocity } };
  return { ...scene, cloth, method: { step_s: kStep, ...method } };
}

/** Wool that falls on a ball, from one state at first contact, resting and bouncing. */
async function contact() {
  const kExplicit = { stepper: 'explicit', substeps: 'stable' };
  const kThrown = [1.5, 0, 0.5];
  const kScenes = {
    explicit: wool(kExplicit, [0, 0, 0]),
    'explicit, thrown': wool(kExplicit, kThrown),
    'explicit, forward Euler': wool({ ...kExplicit, euler: 'forward' }, [0, 0, 0]),
    'imex, 8 substeps': wool({ stepper: 'imex', substeps: 8 }, [0, 0, 0]),
    'imex, 8 substeps, thrown': wool({ stepper: 'imex', substeps: 8 }, kThrown),
    'imex, 64 substeps': wool({ stepper: 'imex', substeps: 64 }, [0, 0, 0]),
  };
  const rows = Object.entries(kScenes).map(([label, scene]) => {
    tell(`wool on a ball: ${label}`);
    return { label, ...ask('bench', 'response', scene) };
  });
  const percent = (share) => (share === null ? '-' : short(100 * share));
  const lines = rows.flatMap((row) =>
    ['resting', 'uniform'].map((response) => [
      row.label,
      response,
      short(1e3 * row.first_contact_s),
      short(1e6 * row.substep_s),
      row[response].n_touched,
      short(1e3 * row[response].rms_normal_velocity_m_per_s),
      percent(row[response].tangential_velocity_deviation),
      percent(row[response].momentum_deviation),
      percent(row[response].contact_share),
    ]),
  );
  const head = [
    'method',
    'response',
    'first contact ms',
    'substep us',
    'touched',
    'RMS normal velocity mm/s',
    'tangential velocity off %',
    'momentum off %',
    'contact, % of a step',
  ];
  const [explicit, thrown, , imex] = rows;
  const ratio = ({ resting, uniform }) =>
    resting.rms_normal_velocity_m_per_s / uniform.rms_normal_velocity_m_per_s;
  const off = (key) =>
    Math.max(...rows.flatMap(({ resting, uniform }) => [resting[key] ?? 0, uniform[key] ?? 0]));
  return {
    rows,
    goals: [
      goal('wool_resting_to_uniform_explicit', ratio(explicit), 'at-most', 0.2),
      goal('wool_resting_to_uniform_explicit_thrown', ratio(thrown), 'at-most', 0.2),
      goal('wool_resting_to_uniform_imex', ratio(imex), 'at-most', 0.2),
      goal('wool_tangential_velocity_off', off('tangential_velocity_deviation'), 'at-most', 0.01),
      goal('wool_momentum_off', off('momentum_deviation'), 'at-most', 0.01),
    ],
    text: markdown(head, lines),
  };
}

/** Other scenes, fabrics and steps: what no goal names. */
async function elsewhere({ repeat }) {
  const kScenes = [
    ['curtain, its own fabric', (method) => shipped('curtain', method)],
    ['tablecloth, its own fabric', (method) => shipped('tablecloth', method)],
    ['skirt in a walk', skirt],
    ['swinging sheet', (method) => shipped('swinging_sheet', method)],
    ['pendulum of denim', (method) => pendulum(10, method, { fabric: 'coarse cotton (denim)' })],
    ['pendulum of silk', (method) => pendulum(10, method, { fabric: 'silk' })],
    [
      'pendulum, 2 substeps',
      (method) => pendulum(10, { ...method, ...(method.substeps && { substeps: 2 }) }),
    ],
    [
      'pendulum, 20 substeps',
      (method) => pendulum(10, { ...method, ...(method.substeps && { substeps: 20 }) }),
    ],
  ];
  const rows = [];
  const lines = [];
  for (const [name, sceneOf] of kScenes) {
    const found = await compared({
      repeat,
      sceneOf,
      vertices: 100,
      frames: 30,
      methods: {
        'implicit, cg': kImplicit,
        'imex, sor': kImex,
        'imex, cg': { ...kImex, solver: 'cg' },
      },
    });
    const [, sor, cg] = overFirst(found);
    lines.push([name, ...[sor, cg].flatMap(({ time, error }) => [short(time), short(error)])]);
    rows.push(...found);
  }
  const head = ['scene', 'sor: time', 'error', 'cg: time', 'error'];
  const text = `over implicit with cg\n\n${markdown(head, lines)}\n\n${described(rows)}`;
  return { rows, goals: [], text };
}

await runParts('imex', 'implicit where it must be, explicit where it can be', {
  pendulum: onPendulum,
  contact,
  larger,
  finer,
  elsewhere,
});
