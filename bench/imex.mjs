// ./pleat bench imex (--help tells the options)
// Savings of treating only those springs implicitly that need it, and where it does not pay.
import { shippedScene } from './parts/assets.mjs';
import { tell } from './parts/bench-options.mjs';
import { runParts } from './parts/bench-parts.mjs';
import { atMost, described, exponent, markdown, table } from './parts/bench-rows.mjs';
import { ask } from './parts/command.mjs';
import { againstNewton } from './parts/contestants.mjs';
import { by, kStep, squareSheet } from './parts/sheets.mjs';

const kFrames = 100;
const kSubsteps = 7; // substeps of 2.4 ms
const kTolerance = 1e-4;

const imex = (solver, more = {}) => ({ stepper: 'imex', substeps: kSubsteps, solver, ...more });
const iterated = { tolerance: kTolerance };
const kImplicit = { ...imex('cg', iterated), stepper: 'implicit' };
const kImex = imex('sor', iterated);
const kImexCg = imex('cg', iterated);

/**
 * A sheet of 0.2 kg/m^2, n x n particles on a square with sides of `size` [m], let go from the
 * horizontal, two corners held.
 */
const pendulum = (n, { fabric = 'fine cotton', size = 1 } = {}) => ({
  name: `pendulum ${n}x${n} over ${size} m, ${fabric}`,
  cloth: squareSheet(n, [0, 1.5, 0], [1, 0, 0], [0, 0, 1], size),
  fabric: {
    name: fabric,
    overrides: { damping_ratio: 0.02, areal_density_kg_per_m2: 0.2 },
  },
  pins: [{ part: 'upper_left' }, { part: 'lower_left' }],
  duration_s: kFrames * kStep,
});

/** The scene by several methods in turn, against `newton`; methods: {label: method} */
function compared(scene, methods, { frames = kFrames, exactSteps = 64, repeat }) {
  const scenes = Object.entries(methods).map(([label, method]) => [label, by(scene, method)]);
  return againstNewton(Object.fromEntries(scenes), scene, { repeat, frames, exactSteps });
}

const lastError = (row) => Object.values(row.position_errors_m).at(-1);

/** Time and error over those of the first row. */
const overFirst = (rows) =>
  rows.map((row) => ({
    time: row.times_as_long_as_first,
    error: lastError(row) / lastError(rows[0]),
  }));

async function onPendulum({ repeat }) {
  const methods = {
    'implicit, cg': kImplicit,
    'imex, sor': kImex,
    'imex, cg': kImexCg,
    'imex, cholmod': imex('cholmod'),
    'imex_fixed, sor': { ...kImex, split: 'structural' },
    'rk4, largest stable step': { stepper: 'rk4', substeps: 'stable' },
  };
  const rows = await compared(pendulum(10), methods, { repeat });
  const [, { time, error }] = overFirst(rows);
  const judged = rows.slice(0, 2);
  const goals = [
    atMost('imex_sor_time_to_implicit_cg', time, 0.6, judged),
    atMost('imex_sor_error_to_implicit_cg', error, 1, judged),
  ];
  return { rows, goals };
}

const kGrowing = {
  'imex, sor': kImex,
  'imex, cg': kImexCg,
  'imex, supernodal': imex('supernodal'),
  'implicit, cg': kImplicit,
};

/** How the time of a frame grows with the vertices of n x n particles over sizeOf(n) [m]. */
async function grown(name, repeat, sizeOf) {
  const kSides = [10, 20, 40, 80];
  const rows = [];
  for (const n of kSides) {
    const scene = pendulum(n, { size: sizeOf(n) });
    rows.push(...(await compared(scene, kGrowing, { repeat, frames: 15, exactSteps: 8 })));
  }
  const slope = (label) => {
    const own = rows.filter((row) => row.label.endsWith(label));
    return exponent(own.map((row) => [row.n_vertices, row.ms_per_frame]));
  };
  const goals = ['imex, sor', 'imex, cg'].map((label) =>
    atMost(`growth_${name}_${label.replace(', ', '_')}`, slope(label), 1.2, rows),
  );
  return { rows, goals };
}

/** A larger cloth with the same mesh width: each particle's springs and mass stay as they are. */
const larger = ({ repeat }) => grown('larger', repeat, (n) => (n - 1) / 9);

/** A finer mesh of one cloth: a substep reaches ever more cells. */
const finer = ({ repeat }) => grown('finer', repeat, () => 1);

/** The preset's wool with another method, let go or thrown. */
function wool(method, initial_velocity_m_per_s = [0, 0, 0]) {
  const scene = shippedScene('wool');
  Object.assign(scene.cloth.knit, { initial_velocity_m_per_s });
  return by(scene, method);
}

/** Wool that falls on a ball, from one state at first contact, resting and bouncing. */
async function contact() {
  const kExplicit = { stepper: 'explicit', substeps: 'stable' };
  const kThrown = [1.5, 0, 0.5];
  const imexBy = (substeps) => ({ stepper: 'imex', substeps });
  const kScenes = {
    explicit: wool(kExplicit),
    'explicit, thrown': wool(kExplicit, kThrown),
    'explicit, forward Euler': wool({ ...kExplicit, euler: 'forward' }),
    'imex, 8 substeps': wool(imexBy(8)),
    'imex, 8 substeps, thrown': wool(imexBy(8), kThrown),
    'imex, 64 substeps': wool(imexBy(64)),
  };
  const rows = Object.entries(kScenes).map(([label, scene]) => {
    tell(`wool on a ball: ${label}`);
    return { label, ...ask('bench', 'response', scene) };
  });
  const responses = rows.flatMap(({ label, first_contact_s, substep_s, resting, uniform }) =>
    Object.entries({ resting, uniform }).map(([response, found]) => ({
      label,
      first_contact_s,
      substep_s,
      response,
      ...found,
    })),
  );
  const percent = (key) => (row) => 100 * (row[key] ?? Number.NaN);
  const columns = {
    method: 'label',
    response: 'response',
    'first contact ms': (row) => 1e3 * row.first_contact_s,
    'substep us': (row) => 1e6 * row.substep_s,
    touched: 'n_touched',
    'RMS normal velocity mm/s': (row) => 1e3 * row.rms_normal_velocity_m_per_s,
    'tangential velocity off %': percent('tangential_velocity_deviation'),
    'momentum off %': percent('momentum_deviation'),
    'contact, % of a step': percent('contact_share'),
  };
  const [explicit, thrown, , inImex] = rows;
  const ratio = ({ resting, uniform }) =>
    resting.rms_normal_velocity_m_per_s / uniform.rms_normal_velocity_m_per_s;
  const off = (key) => Math.max(...responses.map((response) => response[key] ?? 0));
  return {
    rows,
    goals: [
      atMost('wool_resting_to_uniform_explicit', ratio(explicit), 0.2),
      atMost('wool_resting_to_uniform_explicit_thrown', ratio(thrown), 0.2),
      atMost('wool_resting_to_uniform_imex', ratio(inImex), 0.2),
      atMost('wool_tangential_velocity_off', off('tangential_velocity_deviation'), 0.01),
      atMost('wool_momentum_off', off('momentum_deviation'), 0.01),
    ],
    text: table(responses, columns),
  };
}

/** Other scenes, fabrics and steps: no goal names them. */
async function elsewhere({ repeat }) {
  const skirt = { ...shippedScene('garments/skirt_walk'), refinement: { level: 0 } };
  const of = (fabric) => pendulum(10, { fabric });
  // [scene, substeps]
  const kScenes = {
    'curtain, its own fabric': [shippedScene('curtain')],
    'tablecloth, its own fabric': [shippedScene('tablecloth')],
    'skirt in a walk': [skirt],
    'swinging sheet': [shippedScene('swinging_sheet')],
    'pendulum of denim': [of('coarse cotton (denim)')],
    'pendulum of silk': [of('silk')],
    'pendulum, 2 substeps': [pendulum(10), 2],
    'pendulum, 20 substeps': [pendulum(10), 20],
  };
  const rows = [];
  const lines = [];
  for (const [name, [scene, substeps = kSubsteps]] of Object.entries(kScenes)) {
    const methods = {
      'implicit, cg': { ...kImplicit, substeps },
      'imex, sor': { ...kImex, substeps },
      'imex, cg': { ...kImexCg, substeps },
    };
    const found = await compared(scene, methods, { repeat, frames: 30 });
    const [, ...both] = overFirst(found);
    lines.push([name, ...both.flatMap(({ time, error }) => [time, error])]);
    rows.push(...found);
  }
  const head = ['scene', 'sor: time', 'error', 'cg: time', 'error'];
  const text = `over implicit with cg\n\n${markdown(head, lines)}\n\n${described(rows)}`;
  return { rows, goals: [], text };
}

const parts = { pendulum: onPendulum, contact, larger, finer, elsewhere };
await runParts('imex', 'implicit where it must be, explicit where it can be', parts);
