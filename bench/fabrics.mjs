// ./pleat bench fabrics (--help tells the options)
// What a shape of least deformation energy costs, from its mesh and under a moving hand, natively
// and in WebAssembly; how much it depends on the mesh; and whether fabrics' weights show in it.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

import { runParts, tell } from './parts/bench-parts.mjs';
import { exponent, goal, markdown, median, short } from './parts/bench-rows.mjs';
import { ask, root } from './parts/command.mjs';
import { deformWasm } from './parts/contestants.mjs';

const kMoves = 20; // of a hand, from rest to the scene's targets
const kLargest = ['ball', 'diagonal_stretch', 'wrinkles']; // 51 x 51 vertices each
const kTerms = ['recovery', 'stretch', 'bending'];

const sceneFile = (name) => join(root, 'assets', 'deform', `${name}.json`);
const fabrics = JSON.parse(
  readFileSync(join(root, 'assets', 'fabrics', 'fabrics.json')),
).fabrics.map((fabric) => fabric.name_en);

const everyFabric = kLargest.flatMap((scene) => fabrics.map((fabric) => ({ scene, fabric })));

/** The paper's table 3: [linearise ms, solve ms, iterations], of the scene that is ours. */
const kPaper = {
  terms: [3.2, 16, 5],
  pull: [41.5, 19.1, 5],
  ball: [48.5, 245, 15],
  half_skirt: [12.5, 45, 10],
  t_shirt: [25, 13, 10],
};

/** Least deformation energy of a scene, or of its file, as `pleat bench deform` tells it. */
const deformNative = (scene, options = []) => ask('bench', 'deform', scene, ...options);

function rounds(repeat, contestants) {
  const found = contestants.map(() => []);
  for (let round = 0; round < repeat; ++round)
    for (const [i, { label, run }] of contestants.entries()) {
      tell(`round ${round + 1} of ${repeat}: ${label}`);
      found[i].push(run());
    }
  return found;
}

/** One row of a scene's runs: times are medians, the rest is the same in all of them. */
function row(label, runs) {
  const [first] = runs;
  const mid = (key) => median(runs.map((run) => run.cost[key]));
  return {
    ...first,
    label,
    cost: Object.fromEntries(
      Object.entries(first.cost).map(([key, value]) =>
        key.endsWith('_ms') ? [key, mid(key)] : [key, value],
      ),
    ),
    spread_ms:
      Math.max(...runs.map((run) => run.cost.total_ms)) -
      Math.min(...runs.map((run) => run.cost.total_ms)),
    n_runs: runs.length,
    status: first.cost.status,
    drag: first.drag && {
      update_ms: first.drag.update_ms.map((_, k) =>
        median(runs.map((run) => run.drag.update_ms[k])),
      ),
      excess: first.drag.excess,
    },
  };
}

function costTable(rows) {
  const head = [
    'scene',
    'target',
    'vertices',
    'faces',
    'edges',
    'build ms',
    'linearise ms',
    'solve ms/step',
    'linearisations',
    'steps',
    'total ms',
    'spread',
    'energy',
    'status',
    'paper: linearise, solve ms, iterations',
  ];
  const lines = rows.map(({ label, paper, cost, ...shape }) => [
    label,
    shape.target,
    shape.n_vertices,
    shape.n_triangles ?? '',
    shape.n_edges ?? '',
    short(cost.build_ms),
    short(cost.assembly_ms + cost.factor_ms),
    short(cost.solve_ms),
    cost.linearisations,
    cost.steps,
    short(cost.total_ms),
    short(shape.spread_ms),
    cost.energy.toPrecision(6),
    cost.status,
    paper?.join(', ') ?? '',
  ]);
  return markdown(head, lines);
}

/** From mesh to least energy: the paper's table 3 beside ours, then every fabric at 51 x 51. */
async function solve({ repeat, scale }) {
  const scenes = [...Object.keys(kPaper), ...kLargest.filter((name) => !kPaper[name])];
  const shown = rounds(
    repeat,
    scenes.map((name) => ({ label: name, run: () => deformNative(sceneFile(name)) })),
  ).map((runs, i) => ({ ...row(scenes[i], runs), paper: kPaper[scenes[i]] }));
  const others = rounds(
    1,
    everyFabric.map(({ scene, fabric }) => ({
      label: `${scene}, ${fabric}`,
      run: () => deformNative(sceneFile(scene), ['--fabric', fabric]),
    })),
  ).map((runs, i) => row(`${everyFabric[i].scene}, ${everyFabric[i].fabric}`, runs));
  const largest = shown.filter(({ label }) => kLargest.includes(label));
  const worst = others.reduce((a, b) => (a.cost.total_ms > b.cost.total_ms ? a : b));
  const goals = [
    goal(
      'full_solve_2601_ms_native',
      Math.max(...largest.map(({ cost }) => cost.total_ms)),
      'at-most',
      600 * scale,
      largest,
    ),
    goal('full_solve_2601_all_fabrics_ms_native', worst.cost.total_ms, 'at-most', 600 * scale, [
      worst,
    ]),
  ];
  return {
    rows: [...shown, ...others],
    goals,
    text: `\n\n${costTable(shown)}\n\nworst of 15 fabrics:\n\n${costTable([worst])}`,
  };
}

function dragTable(rows) {
  const head = ['scene', 'target', 'update ms: median', 'largest', 'energy above the least %'];
  return markdown(
    head,
    rows.map(({ label, target, drag }) => [
      label,
      target,
      short(median(drag.update_ms)),
      short(Math.max(...drag.update_ms)),
      short(100 * Math.max(...drag.excess)),
    ]),
  );
}

function dragGoals(rows, target, ms) {
  const worst = (values) => Math.max(...rows.flatMap(values));
  return [
    goal(
      `drag_update_2601_ms_${target}`,
      worst(({ drag }) => drag.update_ms),
      'at-most',
      ms,
      rows,
    ),
    goal(
      `drag_energy_above_least_percent_${target}`,
      100 * worst(({ drag }) => drag.excess),
      'at-most',
      5,
      rows,
    ),
  ];
}

/** A hand that takes the handles from rest to their targets in equal moves. */
async function drag({ repeat, scale }) {
  const options = ['--drag', String(kMoves)];
  const rows = rounds(
    repeat,
    kLargest.map((name) => ({
      label: name,
      run: () => deformNative(sceneFile(name), options),
    })),
  ).map((runs, i) => row(kLargest[i], runs));
  const others = everyFabric.map(({ scene, fabric }) => {
    tell(`${scene}, ${fabric}`);
    const run = deformNative(sceneFile(scene), [...options, '--fabric', fabric]);
    return row(`${scene}, ${fabric}`, [run]);
  });
  const mostExcess = (a, b) => (Math.max(...a.drag.excess) > Math.max(...b.drag.excess) ? a : b);
  const worst = others.reduce(mostExcess);
  const next = others.filter(({ fabric }) => fabric !== worst.fabric).reduce(mostExcess);
  return {
    rows: [...rows, ...others],
    goals: [
      ...dragGoals(rows, 'native', 16 * scale),
      goal(
        'drag_energy_above_least_percent_all_fabrics',
        100 * Math.max(...worst.drag.excess),
        'at-most',
        5,
        others,
      ),
    ],
    text: `\n\n${dragTable(rows)}\n\nworst of 15 fabrics, and of the other 14:\n\n${dragTable([worst, next])}`,
  };
}

async function wasm({ repeat, scale }) {
  const found = [];
  for (const name of kLargest) {
    const runs = [];
    for (let round = 0; round < repeat; ++round) {
      tell(`round ${round + 1} of ${repeat}: ${name}, wasm`);
      runs.push(await deformWasm(sceneFile(name), kMoves));
    }
    found.push(row(name, runs));
  }
  const total = Math.max(...found.map(({ cost }) => cost.total_ms));
  return {
    rows: found,
    goals: [
      goal('full_solve_2601_ms_wasm', total, 'at-most', 1200 * scale, found),
      ...dragGoals(found, 'wasm', 33 * scale),
    ],
    text: `\n\n${costTable(found)}\n\n${dragTable(found)}`,
  };
}

/** One fabric, one pull, two meshes: other triangles, or another fineness. */
async function mesh() {
  const kPairs = [
    ['mesh_329', 'mesh_323'],
    ['mesh_48', 'mesh_441'],
  ];
  const kSide = 0.46; // [m]
  const rows = [];
  const goals = [];
  const lines = [];
  for (const form of ['consistent', 'published'])
    for (const [name, other] of kPairs) {
      const runs = fabrics.map((fabric) => {
        tell(`${name} and ${other}, ${fabric}, ${form}`);
        const words = ['--form', form, '--fabric', fabric, '--against', sceneFile(other)];
        const run = deformNative(sceneFile(name), words);
        const percent = (100 * run.against.largest_m) / kSide;
        return { ...row(`${name} and ${other}, ${fabric}, ${form}`, [run]), form, percent };
      });
      runs.sort((a, b) => a.percent - b.percent);
      const [least, middle, most] = [0, 7, 14].map((k) => runs[k]);
      const counts = `${least.n_vertices} and ${least.against.n_vertices}`;
      lines.push([
        `${counts} vertices, ${form}`,
        ...[least, middle, most].map(({ percent, fabric }) => `${short(percent)} (${fabric})`),
      ]);
      rows.push(...runs);
      const goalName = `mesh_distance_percent_${counts.replaceAll(' ', '_')}`;
      if (form === 'consistent') goals.push(goal(goalName, most.percent, 'at-most', 5, runs));
    }
  const head = ['largest distance, % of the side', 'least', 'median', 'most of 15 fabrics'];
  return { rows, goals, text: `\n\n${markdown(head, lines)}` };
}

/** The pulled sheet of about so many vertices. */
function pulledSheet(n) {
  const scene = JSON.parse(readFileSync(sceneFile('pull')));
  const { sheet } = scene.cloth;
  const across = Math.round(Math.sqrt((n * sheet.height_m) / sheet.width_m));
  sheet.vertices = [Math.round(n / across), across];
  return scene;
}

/** Time to the least energy of the same sheet, more and more finely cut. */
async function growth({ repeat }) {
  const kVertices = [500, 1000, 2000, 5000, 10_000, 20_000];
  const rows = rounds(
    repeat,
    kVertices.map((n) => ({
      label: `${n} vertices`,
      run: () => deformNative(pulledSheet(n)),
    })),
  ).map((runs, i) => row(`pull, about ${kVertices[i]} vertices`, runs));
  const slope = exponent(rows.map(({ n_vertices, cost }) => [n_vertices, cost.total_ms]));
  return {
    rows,
    goals: [goal('growth_exponent', slope, 'at-most', 1.6, rows)],
    text: `\n\n${costTable(rows)}`,
  };
}

/** Spearman's; ties share their ranks. */
function rankCorrelation(a, b) {
  const ranks = (values) =>
    values.map((value) => {
      const below = values.filter((other) => other < value).length;
      const equal = values.filter((other) => other === value).length;
      return below + (equal - 1) / 2;
    });
  const [p, q] = [ranks(a), ranks(b)];
  const mid = (a.length - 1) / 2;
  const product = (x, y) => x.reduce((sum, rank, i) => sum + (rank - mid) * (y[i] - mid), 0);
  return product(p, q) / Math.sqrt(product(p, p) * product(q, q));
}

/** Does a fabric with more weight on a term have less of it? All 15 under one pull. */
async function weights() {
  const rows = [];
  const goals = [];
  const lines = [];
  for (const form of ['published', 'consistent']) {
    const runs = fabrics.map((fabric) => {
      tell(`${fabric}, ${form}`);
      const run = deformNative(sceneFile('fifteen'), ['--fabric', fabric, '--form', form]);
      return { ...row(`fifteen, ${fabric}, ${form}`, [run]), form };
    });
    const correlations = kTerms.map((term) =>
      rankCorrelation(
        runs.map((run) => run.weights[term]),
        runs.map((run) => run.cost.terms[term]),
      ),
    );
    lines.push([form, ...correlations.map(short)]);
    rows.push(...runs);
    if (form === 'published')
      for (const [k, term] of kTerms.entries())
        goals.push(goal(`rank_correlation_${term}`, correlations[k], 'at-most', -0.8, runs));
  }
  const head = ['form', ...kTerms.map((term) => `rank correlation: ${term}`)];
  return { rows, goals, text: `\n\n${markdown(head, lines)}` };
}

/** Where the posed T-shirt is wrinkled: at its arms, or on its body too. */
async function shirt() {
  const kArm = 0.2; // [m] from the middle
  const kFabrics = ['coarse cotton (denim)', 'canvas', 'silk', 'nylon'];
  const rows = kFabrics.map((fabric) => {
    tell(`T-shirt, ${fabric}`);
    const words = ['--fabric', fabric, '--vertices'];
    const { vertices, ...run } = deformNative(sceneFile('t_shirt'), words);
    const bending = { arms: 0, body: 0 };
    vertices.bending.forEach((share, v) => {
      bending[Math.abs(vertices.rest_m[3 * v]) > kArm ? 'arms' : 'body'] += share;
    });
    return { ...row(`T-shirt, ${fabric}`, [run]), bending };
  });
  const text = markdown(
    ['T-shirt', 'E_A at the arms', 'E_A on the body', 'arms / body'],
    rows.map(({ fabric, bending: { arms, body } }) => [
      fabric,
      short(arms),
      short(body),
      short(arms / body),
    ]),
  );
  return { rows, goals: [], text: `\n\n${text}` };
}

await runParts('fabrics', 'Shapes of least deformation energy: cost, and what they depend on.', {
  solve,
  drag,
  wasm,
  mesh,
  growth,
  weights,
  shirt,
});
