// npm run failure-rows: each case of the view of failures by both of its methods, in WebAssembly; one line of JSON for
// each: when the naive side shows its sign, whether ours shows any, and what a step of both takes.
import { firstCore } from '../../build-steps/built-core.ts';
import { openPageCode } from './page-code.mjs';

const code = await openPageCode();
const { CASES, SIDES, STEP_S, sceneTextOf } = await code.load(
  '/src/failures/state/failure-cases.ts',
);
const { fabricsText } = await code.load('/src/shared/fabric/fabric-data.ts');

function median(values) {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[sorted.length >> 1];
}

/** The signs of a side, when the first one is seen [s], and the median time of a step [ms]. */
async function played(one, side) {
  const module = await firstCore();
  const run = new module.Simulation(fabricsText);
  const answer = JSON.parse(run.load(sceneTextOf(one, side)));
  if (!answer.ok) throw new Error(`${one.id}: ${answer.what}`);
  const signs = new Map();
  const times = [];
  const nSteps = Math.round(one.endS / STEP_S);
  let hasEnded = false;
  for (let step = 1; step <= nSteps && !hasEnded; ++step) {
    const beginMs = performance.now();
    hasEnded = run.step(1) !== 0;
    times.push(performance.now() - beginMs);
    const timeS = step * STEP_S;
    const { warnings } = JSON.parse(run.numbers());
    const isMeasured = one.measure && one.measure.of(run.positions(), timeS) > one.measure.bound;
    const seen = [...warnings.map(({ kind }) => kind), ...(isMeasured ? ['measured'] : [])];
    for (const sign of [...seen, ...(hasEnded ? ['ended'] : [])])
      if (!signs.has(sign)) signs.set(sign, timeS);
  }
  run.delete();
  return { signs, ms: median(times), n: answer.summary.n_vertices };
}

for (const one of CASES) {
  const [naive, ours] = [await played(one, SIDES[0]), await played(one, SIDES[1])];
  const row = {
    case: one.id,
    n_vertices: naive.n,
    sign: one.sign,
    sign_s: naive.signs.get(one.sign) ?? null,
    ours: [...ours.signs.keys()],
    naive_ms: naive.ms,
    ours_ms: ours.ms,
    status: 'ok',
  };
  console.log(JSON.stringify(row));
}
await code.close();
process.exit();
