// Pulls by a hand that a visitor could make, and whether the run raises an alarm over them: cloth
// that was pulled and let go is no fault of its method.
import { fabricsText, shippedScene } from './assets.mjs';
import { tell } from './bench-options.mjs';
import { atMost, table } from './bench-rows.mjs';
import { answer, wasmModule } from './contestants.mjs';

const kPulls = 40;
const kScenes = ['curtain', 'tablecloth', 'swinging_sheet'];
const kSteppers = ['implicit', 'multigrid', 'xpbd'];
const kFrame = 1 / 60; // [s]
const kBefore = 0.5; // [s] of the run until the hand comes
const kAfter = 3; // [s] from when it lets go, most of them watched

/** Numbers in [0, 1) that are the same in every run (Lehmer's generator). */
function randomNumbers(seed) {
  const kModulus = 2 ** 31 - 1;
  let state = seed;
  return () => {
    state = (48271 * state) % kModulus;
    return state / kModulus;
  };
}

/** A way of up to 1.5 m in any direction, in 0.1 to 1 s, from any vertex; then it is held a while. */
function randomPull(random, nVertices) {
  const vertex = Math.floor(random() * nVertices);
  const up = 2 * random() - 1;
  const turn = 2 * Math.PI * random();
  const metres = 0.1 + 1.4 * random();
  const flat = Math.sqrt(1 - up * up);
  const way = [flat * Math.cos(turn), up, flat * Math.sin(turn)].map((part) => metres * part);
  return { vertex, metres, way, seconds: 0.1 + 0.9 * random(), held: 0.5 * random() };
}

function opened(module, scene, stepper) {
  const run = new module.Simulation(fabricsText());
  const method = scene.method.stepper === stepper ? scene.method : { stepper };
  answer(run.load(JSON.stringify({ ...scene, method })));
  return run;
}

/** The warnings of a run with a pull, and how far the cloth was stretched while it was held. */
function pulled(module, scene, stepper, random) {
  const run = opened(module, scene, stepper);
  const told = [];
  let stretch = 0;
  const step = (frames, move = null) => {
    for (let frame = 1; frame <= Math.round(frames); ++frame) {
      move?.(frame);
      run.step(1);
      const { warnings, largest_stretch } = answer(run.numbers());
      for (const { kind } of warnings) if (!told.includes(kind)) told.push(kind);
      if (move) stretch = Math.max(stretch, largest_stretch);
    }
  };
  step(kBefore / kFrame);
  const pull = randomPull(random, run.positions().length / 3);
  const place = [0, 1, 2].map((k) => run.positions()[3 * pull.vertex + k]);
  const frames = Math.round(pull.seconds / kFrame);
  answer(run.grab(pull.vertex));
  step(frames + pull.held / kFrame, (frame) => {
    const share = Math.min(frame / frames, 1);
    run.moveGrab(...place.map((x, k) => x + share * pull.way[k]));
  });
  run.releaseGrab();
  step(kAfter / kFrame);
  const { largest_stretch: left } = answer(run.numbers());
  const { status } = answer(run.status());
  run.delete();
  return { metres: pull.metres, told, stretch, left, status };
}

export async function pulls() {
  const module = await wasmModule();
  const random = randomNumbers(20261128);
  const rows = Array.from({ length: kPulls }, (_, index) => {
    const name = kScenes[index % kScenes.length];
    const stepper = kSteppers[Math.floor(index / kScenes.length) % kSteppers.length];
    tell(`pull ${index + 1} of ${kPulls}: ${name}, ${stepper}`);
    return { scene: name, stepper, ...pulled(module, shippedScene(name), stepper, random) };
  });
  const alarms = rows.filter(({ told }) => told.length > 0);
  const columns = {
    scene: 'scene',
    stepper: 'stepper',
    'way of the hand m': 'metres',
    'stretch while held %': ({ stretch }) => 100 * stretch,
    'left after 3 s %': ({ left }) => 100 * left,
    told: ({ told }) => told.join(', ') || '-',
  };
  return {
    rows,
    goals: [atMost('alarms_of_pulls', alarms.length, 0, rows)],
    text: `${kPulls} pulls of random place, way and time\n\n${table(rows, columns)}`,
  };
}
