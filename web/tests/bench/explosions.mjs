// npm run explosions: settings that explode, played and mended by the page's own code on its WebAssembly, in
// this thread; one line of JSON for each.
import { firstCore } from '../../build-steps/built-core.ts';
import { openPageCode } from './page-code.mjs';

/** Too few substeps or rounds, and steps that are too long. */
const kExplosions = [
  'scene=curtain&level=1&stepper=xpbd&substeps=1',
  'scene=curtain&level=2&stepper=xpbd&substeps=1',
  'scene=curtain&level=3&stepper=xpbd&substeps=1',
  'scene=curtain&fabric=leather&stepper=xpbd&substeps=2',
  'scene=curtain&stepper=pbd&substeps=1&iterations=1',
  'scene=curtain&level=3&stepper=hpbd&substeps=1',
  'scene=tablecloth&level=1&stepper=xpbd&substeps=1',
  'scene=tablecloth&level=2&stepper=xpbd&substeps=1',
  'scene=tablecloth&fabric=canvas&stepper=xpbd&substeps=2',
  'scene=tablecloth&fabric=leather&level=3&stepper=xpbd&substeps=4',
  'scene=tablecloth&level=3&stepper=pbd&substeps=1',
  'scene=tablecloth&level=3&stepper=projective&iterations=1',
  'scene=tablecloth&stepper=multigrid&substeps=1&step=1/30',
  'scene=swinging-sheet&stepper=xpbd&substeps=1',
  'scene=swags&stepper=xpbd&substeps=2',
  'scene=flag&stepper=xpbd&substeps=1',
  'scene=wind&stepper=hpbd&substeps=1',
  'scene=wind&stepper=multigrid&substeps=1&step=1/30',
  'scene=ball&level=3&stepper=xpbd&substeps=1&step=1/30',
  'scene=ball&stepper=imex&substeps=1&step=1/30',
];

const kToldS = 2.5; // end of the time in which each is told [s of motion]
const kHealedS = 4; // a remedy is watched so long from where it begins [s of motion]
const kPatienceMs = 120000;
const kSpeed = 8; // seconds of motion a second, at most

globalThis.requestAnimationFrame = (work) => setTimeout(work, 1);

const code = await openPageCode();
const { MotionRun } = await code.load('/src/motion/run/motion-run.ts');
const { tellWarnings } = await code.load('/src/motion/run/warnings.ts');
const { decodeMotionLink } = await code.load('/src/motion/state/motion-link.ts');
const { initialMotionState } = await code.load('/src/motion/state/motion-state.ts');
const { createStore } = await code.load('/src/shared/state/store.ts');
const { createAsked } = await code.load('/src/shared/workers/asked.ts');
const { MotionCore } = await code.load('/src/shared/workers/motion-core.ts');
const { workerPort } = await code.load('/tests/support/worker-port.ts');
const module = await firstCore();

const start = (listener) =>
  createAsked(
    workerPort((post) => new MotionCore(module, post)),
    listener,
  );

/** The state that fulfils `test`; null where none did for so long. */
async function until(store, test) {
  const end = performance.now() + kPatienceMs;
  while (!test(store.get())) {
    if (performance.now() > end) return null;
    await new Promise((resume) => setTimeout(resume, 5));
  }
  return store.get();
}

/** A visitor plays a link, waits for what is offered, and presses it. */
async function visit(link) {
  const { link: read, problems } = decodeMotionLink(link);
  if (problems.length > 0) throw new Error(`${link}: ${problems.join('; ')}`);
  const store = createStore({ ...initialMotionState(read, []), speed: kSpeed });
  const run = new MotionRun(store, { showMesh() {}, showFrame() {} }, start);
  tellWarnings(store, run, start);
  const row = {
    link,
    status: 'ok',
    told: null,
    offered: null,
    begin_s: null,
    healed: false,
    left: null,
  };
  await until(store, ({ phase }) => phase === 'ready');
  run.play();
  const told = await until(
    store,
    ({ problem, numbers, phase }) =>
      problem?.help !== undefined || phase === 'stopped' || numbers.time_s > kToldS,
  );
  row.told = told?.problem?.warning ?? null;
  if (row.told) {
    const offered = await until(store, ({ problem }) => !/^Trying/.test(problem?.help));
    const { remedy, help } = offered?.problem ?? {};
    row.offered = remedy?.title ?? help ?? null;
    if (remedy) {
      run.take(remedy);
      const begun = await until(store, ({ phase }) => phase === 'ready');
      row.begin_s = begun?.numbers.time_s ?? null;
      const after = await until(
        store,
        ({ problem, numbers, phase }) =>
          problem !== null ||
          phase === 'stopped' ||
          numbers.time_s >= (row.begin_s ?? 0) + kHealedS,
      );
      row.left = after?.problem?.warning ?? after?.problem?.sentence ?? null;
      row.healed = after !== null && after.problem === null && after.phase === 'ready';
    }
  }
  run.pause();
  store.set({ problem: null });
  return row;
}

for (const link of kExplosions) console.log(JSON.stringify(await visit(`#${link}`)));
await code.close();
process.exit();
