// ./pleat bench fabrics (--help tells the options)
// Costs of a shape of least deformation energy, from its mesh and under a moving hand, natively and
// in WebAssembly; how much it depends on the mesh; whether fabrics' weights show in it; and how far
// each fabric drapes at a scene's defaults.
import { asset, fabricsText, readJson } from './parts/assets.mjs';
import { tell } from './parts/bench-options.mjs';
import { runParts } from './parts/bench-parts.mjs';
import {
  atMost,
  exponent,
  inTurn,
  markdown,
  median,
  medianRow,
  rankCorrelation,
  short,
  spread,
  table,
} from './parts/bench-rows.mjs';
import { ask } from './parts/command.mjs';
import { deformWasm } from './parts/deform-wasm.mjs';
import { drape } from './parts/fabric-drape.mjs';

const kMoves = 20; // steps of a hand, from rest to the scene's targets
const kLargest = ['ball', 'diagonal_stretch', 'wrinkles']; // 51 x 51 vertices each
const kTerms = ['recovery', 'stretch', 'bending'];

const sceneFile = (name) => asset('deform', `${name}.json`);
const fabrics = JSON.parse(fabricsText()).fabrics.map((fabric) => fabric.name_en);

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

/** One row of a scene's runs: times are medians, the rest is the same in all of them. */
function row(label, runs) {
  const [first] = runs;
  const costs = runs.map((run) => run.cost);
  const times = Object.keys(first.cost).filter((key) => key.endsWith('_ms'));
  return {
    ...first,
    label,
    cost: medianRow(costs, times),
    spread_ms: spread(costs.map((cost) => cost.total_ms)),
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

/** A row of each of [{label, run}], which take turns. */
async function rowsOf(repeat, contestants) {
  const runs = await inTurn(repeat, contestants);
  return runs.map((of, i) => row(contestants[i].label, of));
}

const shownScenes = (repeat, names, options = []) =>
  rowsOf(
    repeat,
    names.map((label) => ({ label, run: () => deformNative(sceneFile(label), options) })),
  );

/** The largest scenes in every fabric, once. */
const inEveryFabric = (options = []) =>
  rowsOf(
    1,
    kLargest.flatMap((scene) =>
      fabrics.map((fabric) => ({
        label: `${scene}, ${fabric}`,
        run: () => deformNative(sceneFile(scene), [...options, '--fabric', fabric]),
      })),
    ),
  );

/** The row of which `of` is the largest. */
const worstOf = (rows, of) => rows.reduce((a, b) => (of(a) > of(b) ? a : b));

const costTable = (rows) =>
  table(rows, {
    scene: 'label',
    target: 'target',
    vertices: 'n_vertices',
    faces: (of) => of.n_triangles ?? '',
    edges: (of) => of.n_edges ?? '',
    'build ms': ({ cost }) => cost.build_ms,
    'linearise ms': ({ cost }) => cost.assembly_ms + cost.factor_ms,
    'solve ms/step': ({ cost }) => cost.solve_ms,
    linearisations: ({ cost }) => cost.linearisations ?? '',
    steps: ({ cost }) => cost.steps,
    'total ms': ({ cost }) => cost.total_ms,
    spread: 'spread_ms',
    energy: ({ cost }) => cost.energy.toPrecision(6),
    status: 'status',
    'paper: linearise, solve ms, iterations': ({ paper }) => paper?.join(', ') ?? '',
  });

const totalMs = ({ cost }) => cost.total_ms;

/** Costs from mesh to least energy: the paper's table 3 beside ours, every fabric at 51 x 51. */
async function solve({ repeat, scale }) {
  const names = [...Object.keys(kPaper), ...kLargest.filter((name) => !kPaper[name])];
  const found = await shownScenes(repeat, names);
  const shown = found.map((one) => ({ ...one, paper: kPaper[one.label] }));
  const others = await inEveryFabric();
  const largest = shown.filter(({ label }) => kLargest.includes(label));
  const most = Math.max(...largest.map(totalMs));
  const worst = worstOf(others, totalMs);
  const bound = 600 * scale;
  return {
    rows: [...shown, ...others],
    goals: [
      atMost('full_solve_2601_ms_native', most, bound, largest),
      atMost('full_solve_2601_all_fabrics_ms_native', totalMs(worst), bound, [worst]),
    ],
    text: `\n\n${costTable(shown)}\n\nworst of 15 fabrics:\n\n${costTable([worst])}`,
  };
}

const slowest = ({ drag }) => Math.max(...drag.update_ms);
const mostExcess = ({ drag }) => 100 * Math.max(...drag.excess);

const dragTable = (rows) =>
  table(rows, {
    scene: 'label',
    target: 'target',
    'update ms: median': ({ drag }) => median(drag.update_ms),
    largest: slowest,
    'energy above the least %': mostExcess,
  });

function dragGoals(rows, target, ms) {
  const most = (of) => Math.max(...rows.map(of));
  return [
    atMost(`drag_update_2601_ms_${target}`, most(slowest), ms, rows),
    atMost(`drag_energy_above_least_percent_${target}`, most(mostExcess), 5, rows),
  ];
}

/** A hand that takes the handles from rest to their targets in equal moves. */
async function drag({ repeat, scale }) {
  const options = ['--drag', kMoves];
  const rows = await shownScenes(repeat, kLargest, options);
  const others = await inEveryFabric(options);
  const worst = worstOf(others, mostExcess);
  const rest = others.filter(({ fabric }) => fabric !== worst.fabric);
  const name = 'drag_energy_above_least_percent_all_fabrics';
  return {
    rows: [...rows, ...others],
    goals: [...dragGoals(rows, 'native', 16 * scale), atMost(name, mostExcess(worst), 5, others)],
    text: `\n\n${dragTable(rows)}\n\nworst of 15 fabrics, and of the other 14:\n\n${dragTable([worst, worstOf(rest, mostExcess)])}`,
  };
}

async function wasm({ repeat, scale }) {
  const run = (name) => () => deformWasm(sceneFile(name), kMoves);
  const rows = await rowsOf(
    repeat,
    kLargest.map((name) => ({ label: name, run: run(name) })),
  );
  const total = Math.max(...rows.map(totalMs));
  return {
    rows,
    goals: [
      atMost('full_solve_2601_ms_wasm', total, 1200 * scale, rows),
      ...dragGoals(rows, 'wasm', 33 * scale),
    ],
    text: `\n\n${costTable(rows)}\n\n${dragTable(rows)}`,
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
        const label = `${name} and ${other}, ${fabric}, ${form}`;
        tell(label);
        const words = ['--form', form, '--fabric', fabric, '--against', sceneFile(other)];
        const run = deformNative(sceneFile(name), words);
        return { ...row(label, [run]), form, percent: (100 * run.against.largest_m) / kSide };
      });
      runs.sort((a, b) => a.percent - b.percent);
      const [least, middle, most] = [0, 7, 14].map((k) => runs[k]);
      const counts = `${least.n_vertices} and ${least.against.n_vertices}`;
      const shown = ({ percent, fabric }) => `${short(percent)} (${fabric})`;
      lines.push([`${counts} vertices, ${form}`, ...[least, middle, most].map(shown)]);
      rows.push(...runs);
      const goalName = `mesh_distance_percent_${counts.replaceAll(' ', '_')}`;
      if (form === 'consistent') goals.push(atMost(goalName, most.percent, 5, runs));
    }
  const head = ['largest distance, % of the side', 'least', 'median', 'most of 15 fabrics'];
  return { rows, goals, text: `\n\n${markdown(head, lines)}` };
}

/** The pulled sheet of about so many vertices. */
function pulledSheet(n) {
  const scene = readJson(sceneFile('pull'));
  const { sheet } = scene.cloth;
  const across = Math.round(Math.sqrt((n * sheet.height_m) / sheet.width_m));
  sheet.vertices = [Math.round(n / across), across];
  return scene;
}

/** Time to the least energy of the same sheet, more and more finely cut. */
async function growth({ repeat }) {
  const contestants = [500, 1000, 2000, 5000, 10_000, 20_000].map((n) => ({
    label: `pull, about ${n} vertices`,
    run: () => deformNative(pulledSheet(n)),
  }));
  const rows = await rowsOf(repeat, contestants);
  const slope = exponent(rows.map((of) => [of.n_vertices, totalMs(of)]));
  const goals = [atMost('growth_exponent', slope, 1.6, rows)];
  return { rows, goals, text: `\n\n${costTable(rows)}` };
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
    lines.push([form, ...correlations]);
    rows.push(...runs);
    if (form === 'published')
      for (const [k, term] of kTerms.entries())
        goals.push(atMost(`rank_correlation_${term}`, correlations[k], -0.8, runs));
  }
  const head = ['form', ...kTerms.map((term) => `rank correlation: ${term}`)];
  return { rows, goals, text: `\n\n${markdown(head, lines)}` };
}

/** Wrinkles of the posed T-shirt: at its arms alone, or on its body too. */
async function shirt() {
  const kArm = 0.2; // [m] from the middle
  const rows = ['coarse cotton (denim)', 'canvas', 'silk', 'nylon'].map((fabric) => {
    tell(`T-shirt, ${fabric}`);
    const words = ['--fabric', fabric, '--vertices'];
    const { vertices, ...run } = deformNative(sceneFile('t_shirt'), words);
    const bending = { arms: 0, body: 0 };
    vertices.bending.forEach((share, v) => {
      bending[Math.abs(vertices.rest_m[3 * v]) > kArm ? 'arms' : 'body'] += share;
    });
    return { ...row(`T-shirt, ${fabric}`, [run]), bending };
  });
  const columns = {
    'T-shirt': 'fabric',
    'E_A at the arms': ({ bending }) => bending.arms,
    'E_A on the body': ({ bending }) => bending.body,
    'arms / body': ({ bending }) => bending.arms / bending.body,
  };
  return { rows, goals: [], text: `\n\n${table(rows, columns)}` };
}

const purpose = 'shapes of least deformation energy: cost, and what they depend on';
await runParts('fabrics', purpose, {
  solve,
  drag,
  wasm,
  mesh,
  growth,
  weights,
  shirt,
  drape,
});
