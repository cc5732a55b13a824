// ./pleat bench refinement (--help tells the options)
// Garments refined where one example motion bends them, against uniform meshes and against
// refinement in every frame: vertices, time and error on a motion that the example does not
// contain; whether the monitor tells motions apart; that no vertex ends inside of the body; and
// what a frame costs in WebAssembly.
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { garmentScene, root } from './parts/assets.mjs';
import { tell, wholeNumber } from './parts/bench-options.mjs';
import { runParts } from './parts/bench-parts.mjs';
import { markdown, short } from './parts/bench-rows.mjs';
import { savingsFigure } from './parts/charts.mjs';
import { commit } from './parts/command.mjs';
import {
  buildRow,
  buildTable,
  comparisonGoals,
  faultTable,
  foldFault,
  foldFloor,
  framesToPay,
  frictionGoals,
  insideGoals,
  monitorGoals,
  monitorTable,
  restartFaults,
  runRow,
  runTable,
  shownLines,
  stretchGoals,
  wasmGoals,
} from './parts/refinement-goals.mjs';
import { answer, keptAnswers, shownPlan } from './parts/refinement-runs.mjs';
import { bothBuilds, differences, kEarly, kTight } from './parts/refinement-wasm.mjs';

const kFineLevel = 2;
const kDuration = 10; // [s], of which the second half is timed and compared
const kQuickDuration = 4; // [s]
const kErrorEvery = 10; // frames
const kAirChange = 1e-6; // change of its density, for each further run of a mesh
const kFurtherRuns = 3;
const kTwin = 'fine, air + 1e-6';
const kRestarts = { every: 0.3, after: 0.25, duration: 5, tolerance: 1e-8 }; // [s]
const kChanceAfter = 5; // [s] of two fine runs
const kDemands = [0.0005, 0.001, 0.0015, 0.002, 0.003]; // losses of the figure's plans [m]
const kDrawn = ['skirt', 'trousers'];
const kFigureFile = join('docs', 'refinement.svg');

/** Curvature at which a garment's mesh of every frame is split [1/m]. */
const kSplitCurvatures = { skirt: 20, trousers: 30, slim_trousers: 30 };

const more = {
  '--method NAME': "of all runs alike, in place of the scenes' own",
  '--substeps N': 'the same',
  '--quick': `${kQuickDuration} s of motion: for trying, no figure`,
  '--resume': 'take what a bench that was stopped has measured already',
};

/** Method and length of all runs of a bench. */
function settings(options) {
  keptAnswers.areTaken = options.resume === true;
  const method = {};
  if (options.method) method.stepper = options.method;
  if (options.substeps) method.substeps = wholeNumber('--substeps', options.substeps, 1);
  return { method, duration: options.quick ? kQuickDuration : kDuration };
}

const at = (scene, duration, more = {}) => ({ ...scene, duration_s: duration, ...more });
const uniform = (level) => ({ refinement: { level } });
const planned = ({ plan }) => ({ refinement: { plan } });

/** A further run, with another chance: how far it comes apart is the least that any error can mean. */
const inHeavierAir = (scene, times = 1) => {
  const { air } = scene.world;
  const density = air.density_kg_per_m3 * (1 + times * kAirChange);
  return { ...scene, world: { ...scene.world, air: { ...air, density_kg_per_m3: density } } };
};

/** The plan that the page shows, and plans of one example run for each length that may be lost. */
function plansOf(garment, { method, duration }) {
  const example = at(garmentScene(garment, 'walk', method), duration, uniform(kFineLevel));
  tell(`${garment}: example run and plans`);
  const demands = kDrawn.includes(garment) ? kDemands : kDemands.slice(-1);
  const found = answer('bench', 'plans', example, '--demand', demands.join());
  return { ...found, chosen: { plan: shownPlan(garment) }, demands: found.plans };
}

/** All meshes of a garment on the test motion, frame by frame in turn. */
function compared(garment, plans, { method, duration }) {
  const test = garmentScene(garment, 'fast_walk', method);
  const even = garmentScene(`${garment}_even`, 'fast_walk', method);
  const scenes = {
    fine: at(test, duration, uniform(kFineLevel)),
    multi: at(test, duration, planned(plans.chosen)),
    same: at(even, duration),
  };
  const further = Object.entries(scenes).flatMap(([mesh, scene]) =>
    Array.from({ length: kFurtherRuns }, (_, k) => [
      `${mesh}, air + ${k + 1}e-6`,
      inHeavierAir(scene, k + 1),
    ]),
  );
  const entries = [
    ['fine', scenes.fine],
    ['multi', scenes.multi],
    ['uniform of as many', scenes.same],
    ['uniform, level 1', at(test, duration, uniform(1))],
    ['coarse', at(test, duration, uniform(0))],
    ...further,
    ...plans.demands.map((found) => [
      `${short(1e3 * found.plan.largest_loss_m)} mm lost`,
      at(test, duration, planned(found)),
    ]),
  ];
  tell(`${garment}: test walk`);
  const [first, ...others] = entries.map(([, scene]) => scene);
  const { runs } = answer(
    ...['bench', 'together', first, '--with', others],
    ...['--adaptive', kSplitCurvatures[garment], '--every', kErrorEvery],
  );
  const labels = [...entries.map(([label]) => label), 'split in every frame'];
  const rows = runs.map((run, k) => runRow(labels[k], run, { garment, commit }));
  return { rows, faults: { ...foldFaults(rows), restarts: restarts(scenes) } };
}

/** Faults of rows in the order of `compared`: each mesh's run and its further ones, pooled. */
function foldFaults(rows) {
  const kBefore = 5;
  const further = (mesh) => kBefore + mesh * kFurtherRuns;
  const pools = [0, 1, 2].map((mesh) =>
    [rows[mesh], ...rows.slice(further(mesh), further(mesh + 1))].map(({ folds_m }) => folds_m),
  );
  const [fine, multi, same] = pools;
  return {
    folds: { multi: foldFault(multi, fine), same: foldFault(same, fine) },
    floor: foldFloor(fine),
  };
}

/** How far meshes go wrong before chance does [m]; of the fine mesh in heavier air, the floor. */
function restarts(scenes) {
  const { every, after, duration, tolerance } = kRestarts;
  const tight = (scene) =>
    at(scene, Math.min(duration, scene.duration_s), { method: { ...scene.method, tolerance } });
  const [fine, multi, same] = Object.values(scenes).map(tight);
  tell(`${fine.name}: restarts`);
  const found = answer(
    ...['bench', 'restarts', fine, '--with', [multi, same, inHeavierAir(fine)]],
    ...['--every', every, '--after', after],
  );
  const [ofMulti, ofSame, ofTwin] = restartFaults(found.restarts);
  return { multi: ofMulti, same: ofSame, twin: ofTwin };
}

/** The planned mesh in other motions. */
function otherMotions(garment, plans, { method, duration }) {
  const run = (label, motion, timeScale = 1) => {
    const scene = at(garmentScene(garment, motion, method), duration, planned(plans.chosen));
    scene.figure = { ...scene.figure, time_scale: timeScale };
    tell(`${garment}: ${label}`);
    const { runs } = answer('bench', 'together', scene, '--every', 1000);
    return runRow(label, runs[0], { garment, commit });
  };
  return {
    example: run('walk', 'walk'),
    squat: run('squat', 'squat'),
    turn: run('turn', 'turn'),
    double: run('walk_at_double_speed', 'walk', 2),
  };
}

function planText(plans, fine, multi) {
  const cells = {
    'example s': plans.example_s,
    'plan s': plans.planning_s,
    'kept MB': plans.kept_bytes / 1e6,
    'peak MB': plans.process_peak_memory_bytes / 1e6,
    frames: plans.n_frames,
    'paid for after frames': framesToPay(plans, fine, multi),
  };
  return markdown(Object.keys(cells), [Object.values(cells)]);
}

const measured = {};

/** All that is found out about a garment, once. */
function study(garment, options) {
  measured[garment] ??= (() => {
    const set = settings(options);
    const plans = plansOf(garment, set);
    return {
      plans,
      ...compared(garment, plans, set),
      others: otherMotions(garment, plans, set),
    };
  })();
  return measured[garment];
}

async function garmentPart(garment, { options }) {
  const { plans, rows, faults, others } = study(garment, options);
  const [fine, multi, same] = rows;
  const twin = rows.find(({ label }) => label === kTwin);
  const test = { ...multi, label: 'test walk' };
  const walks = [others.example, others.double];
  return {
    rows: [...rows, ...Object.values(others)],
    goals: [
      ...comparisonGoals(garment, { fine, multi, same, faults }),
      ...monitorGoals(garment, { ...others, test }),
      ...insideGoals(garment, walks),
      ...stretchGoals(garment, [multi, ...Object.values(others)]),
    ],
    text: `${shownLines(garment, { fine, multi, same, twin })}

errors against ${fine.reference.description}, frames of 1/30 s

${runTable(rows)}

${1 + kFurtherRuns} runs of each mesh, in air heavier by a millionth each; restarts every ${kRestarts.every} s, held ${kRestarts.after} s later

${faultTable(faults)}

${planText(plans, fine, multi)}

${monitorTable([others.example, test, others.turn, others.squat])}

${runTable([fine, ...Object.values(others)])}`,
  };
}

function figurePoints(garment, { rows }) {
  const [fine, multi, same, level1, coarse, ...further] = rows;
  const rest = further.slice(3 * kFurtherRuns);
  const point = (kind) => (row) => ({
    garment,
    kind,
    removed: 100 * (1 - row.n_vertices / fine.n_vertices),
    faster: fine.ms_per_frame / row.ms_per_frame,
    lostMm: 1e3 * (row.errors.sampling_m ?? Number.NaN),
  });
  return [
    ...[same, level1, coarse].map(point('uniform')),
    ...rest.slice(0, kDemands.length).map(point('plan')),
    point('chosen')(multi),
  ];
}

/** Fine runs of the test motion with and without friction inside of bent cloth, each with further ones. */
async function friction({ options }) {
  const { method } = settings(options);
  const test = at(garmentScene('skirt', 'fast_walk', method), kChanceAfter, uniform(kFineLevel));
  const twins = (scene) => {
    const further = Array.from({ length: kFurtherRuns }, (_, k) => inHeavierAir(scene, k + 1));
    tell(`skirt: ${further.length + 1} fine runs`);
    const frames = ['--from', kChanceAfter - 0.1, '--every', 1];
    const { runs } = answer('bench', 'together', scene, '--with', further, ...frames);
    return runs.slice(1).map((run) => runRow('twin', run, { garment: 'skirt', commit }));
  };
  const without = twins(test);
  const withFriction = twins({ ...test, fabric: { ...test.fabric, bending: 'friction' } });
  const { goals, text } = frictionGoals({ without, withFriction });
  return { rows: [...without, ...withFriction], goals, text };
}

/** Savings against error, for five detail demands. */
async function figure({ options }) {
  const studies = kDrawn.map((garment) => [garment, study(garment, options)]);
  const points = studies.flatMap(([garment, found]) => figurePoints(garment, found));
  const notes = studies.map(
    ([garment, { plans }]) =>
      `${garment}: ${short(plans.example_s)} s for the example on ${plans.n_fine_vertices} vertices, ${short(plans.planning_s)} s to plan, ${short(plans.kept_bytes / 1e6)} MB of frames kept; at most ${kDemands.map((lost) => short(1e3 * lost)).join(', ')} mm lost`,
  );
  if (!options.quick) writeFileSync(join(root, kFigureFile), savingsFigure(points, notes));
  return { rows: [], goals: [], text: options.quick ? 'not drawn from short runs' : kFigureFile };
}

/** The planned mesh's run on the test motion: of the garment's part, where that has run. */
function multiRun(garment, scene) {
  if (measured[garment]) return measured[garment].rows[1];
  tell(`${garment}: test walk, fine and planned`);
  const fine = { ...scene, ...uniform(kFineLevel) };
  return answer('bench', 'together', fine, '--with', [scene], '--every', kErrorEvery).runs[1];
}

/** The planned skirt on the test motion, in both builds. */
async function wasm({ repeat, scale, options }) {
  const garment = 'skirt';
  const set = settings(options);
  const { chosen } = plansOf(garment, set);
  const scene = at(garmentScene(garment, 'fast_walk', set.method), set.duration, planned(chosen));
  const { errors, reference } = multiRun(garment, scene);
  const about = { garment, scene, errors, reference, commit };
  const runs = await bothBuilds(scene, repeat);
  const apart = await differences(scene);
  const rows = {
    wasm: { ...buildRow(runs.wasm, about), largest_difference_from_native: apart },
    native: buildRow(runs.native, about),
  };
  return {
    rows: Object.values(rows),
    goals: wasmGoals(garment, rows.wasm, scale),
    text: `${garment}, frames of 1/30 s; errors are the native run's, against ${rows.native.reference.description}

${buildTable(rows)}

largest difference of both after ${kEarly} s: ${short(1e3 * apart.own_m)} mm, solved to ${kTight} ${short(1e3 * apart.tight_m)} mm`,
  };
}

const parts = {
  skirt: (wanted) => garmentPart('skirt', wanted),
  trousers: (wanted) => garmentPart('trousers', wanted),
  slim_trousers: (wanted) => garmentPart('slim_trousers', wanted),
  friction,
  figure,
  wasm,
};
await runParts('refinement', 'garments refined where an example bends', parts, { more });
