// npm run untouched: each scene of the page with each stepper as it starts there, at each level; one line of JSON
// for each, with what the run is warned of.
import { firstCore } from '../../build-steps/built-core.ts';
import { openPageCode } from './page-code.mjs';

const kSeconds = 2;
const kFinest = 3;
/** Most that a run takes [ms]: what so fine a mesh costs there is for the patient. */
const kMostMs = 6000;
/** Steppers whose steps take minutes on fine meshes; none of them has counts that could be too few. */
const kSlow = ['explicit', 'rk4', 'newton'];

const code = await openPageCode();
const { canRun, STEPPERS } = await code.load('/src/shared/steppers/steppers.ts');
const settings = await code.load('/src/motion/state/setting.ts');
const { fabricsText } = await code.load('/src/shared/fabric/fabric-data.ts');
const { levelNeed, levelsOf, PRESET_IDS, presetSetting, sceneOf, withLevel, withStepper } =
  settings;
const { Simulation } = await firstCore();

function ran(setting) {
  const simulation = new Simulation(fabricsText);
  const { ok, what } = JSON.parse(simulation.load(JSON.stringify(sceneOf(setting))));
  if (!ok) throw new Error(what);
  const end = performance.now() + kMostMs;
  let numbers = null;
  let largest = 0;
  for (let step = 0; step < Math.round(kSeconds / setting.stepS); ++step) {
    simulation.step(1);
    numbers = JSON.parse(simulation.numbers());
    largest = Math.max(largest, numbers.largest_stretch);
    if (numbers.warnings.some(({ is_nonsense }) => is_nonsense) || performance.now() > end) break;
  }
  const { status } = JSON.parse(simulation.status());
  simulation.delete();
  const { time_s: seconds, steps_ms, steps_timed, warnings } = numbers;
  const step_ms = steps_ms / steps_timed;
  const told = warnings.map(({ kind, is_nonsense }) => ({ kind, is_nonsense }));
  return { status, seconds, step_ms, largest_stretch: largest, told };
}

for (const scene of PRESET_IDS.filter((id) => id !== 'obj')) {
  const own = presetSetting(scene);
  for (const { name } of STEPPERS.filter(({ name: one }) => canRun(one, own.model)))
    for (const level of levelsOf(scene)) {
      const setting = withLevel(withStepper(own, name), level);
      const isLeftOut = level > (kSlow.includes(name) ? 0 : kFinest) || levelNeed(setting, level);
      if (isLeftOut) continue;
      const { substeps, iterations } = setting;
      const about = { scene, stepper: name, level, substeps, iterations };
      console.log(JSON.stringify({ ...about, ...ran(setting) }));
    }
}
await code.close();
process.exit();
