// npm run sweep-progress: the page's first sweep, and what the page says of its progress at each report; one line of
// JSON for each, with the share of the time that had passed in truth.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { firstCore } from '../../build-steps/built-core.ts';
import { openPageCode } from './page-code.mjs';

const kSliceMs = 150; // SWEEP_SLICE_MS of sweep-core.ts
const kWish = { finest: 1, withSlow: false, ofShown: false };
const kFolder = fileURLToPath(
  new URL('../../../assets/references/sweep/swinging_sheet/', import.meta.url),
);

const code = await openPageCode();
const { sweepPlan, sweptSetting } = await code.load('/src/motion/state/sweep-plan.ts');
const { presetSetting } = await code.load('/src/motion/state/setting.ts');
const { progressOf } = await code.load('/src/motion/state/sweep-progress.ts');
const { fabricsText } = await code.load('/src/shared/fabric/fabric-data.ts');
const { Experiment } = await firstCore();

function answer(text) {
  const { ok, what, ...rest } = JSON.parse(text);
  if (!ok) throw new Error(what);
  return rest;
}

const plan = sweepPlan(sweptSetting(presetSetting('curtain'), kWish), kWish);
const experiment = new Experiment(fabricsText);
for (const id of answer(experiment.start(JSON.stringify(plan))).references)
  answer(experiment.keepReference(readFileSync(`${kFolder}${id}.reference`)));

const begin = performance.now();
const rows = [];
let shown = 0;
for (let done = false; !done; ) {
  const report = answer(experiment.advance(kSliceMs));
  const passed_s = (performance.now() - begin) / 1000;
  const told = progressOf(report, plan, false, passed_s, shown);
  shown = told?.share ?? shown;
  const { rows: measured, message, progress: work } = report;
  rows.push({
    passed_s,
    work,
    shown: told?.share ?? null,
    left_s: told?.leftS ?? null,
    n_rows: measured.length,
    message,
  });
  done = report.done;
}
const whole_s = rows.at(-1).passed_s;
for (const row of rows)
  console.log(JSON.stringify({ status: 'ok', ...row, passed: row.passed_s / whole_s }));
await code.close();
process.exit();
