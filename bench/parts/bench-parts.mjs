// A bench in parts: its options, the yardstick that scales bounds in milliseconds, what it prints.
import { execFileSync } from 'node:child_process';

import { oneOf, readOptions, rowsFile, runBench, wholeNumber } from './bench-options.mjs';
import { median, table } from './bench-rows.mjs';
import { root } from './command.mjs';
import { warmUpYardstick, yardstickTurns } from './contestants.mjs';

const kYardstickMs = 20; // that the bounds in ms are made for

/** What is measured, for the rows. */
export const commit = (() => {
  try {
    return execFileSync('git', ['-C', root, 'describe', '--always', '--dirty'], {
      encoding: 'utf8',
    }).trim();
  } catch {
    return 'unknown';
  }
})();

/** Progress, on stderr. */
export function tell(text) {
  process.stderr.write(process.stderr.isTTY ? `\r\x1b[K${text}` : `${text}\n`);
}

/** What the yardstick takes here, over what the bounds were made for. */
async function machineScale(repeat) {
  const kFrames = 30;
  const kSubsteps = 100;
  warmUpYardstick();
  const runs = [];
  for (let round = 0; round < repeat; ++round) {
    tell(`yardstick, round ${round + 1} of ${repeat}`);
    const run = await yardstickTurns(65, kSubsteps, 'rows', kFrames, []);
    await run.advance(kFrames);
    runs.push(await run.finish());
  }
  const ms = median(runs.map((run) => median(run.ms)));
  const nsPerConstraint = (1e6 * ms) / (kSubsteps * runs[0].n_constraints);
  console.log(
    `yardstick 65x65, ${kSubsteps} substeps, rows: ${ms.toFixed(2)} ms, ${nsPerConstraint.toFixed(2)} ns per constraint;`,
  );
  console.log(`bounds in ms are scaled by ${(ms / kYardstickMs).toFixed(3)}\n`);
  return ms / kYardstickMs;
}

/** What the errors of rows are measured against, and their table. */
export function described(rows) {
  const references = [...new Set(rows.map((row) => row.reference.description))];
  return `errors against ${references.join('; ')}\n\n${table(rows)}`;
}

const usage = (name, purpose, parts, more) => `./pleat bench ${name}   ${purpose}
  --only PART,...   of ${parts.join(', ')} (default: all)
  --repeat N        runs of each contestant, in turn (default 5)
${more.map(({ usage: line }) => `  ${line}\n`).join('')}  --json FILE       write the rows as JSON lines
  --check           exit status 1 when a goal is short
Exit status: 0 done, 1 a goal is short (with --check), 2 bad input.`;

/**
 * Runs the parts that the command line asks for and prints what they found, goals at the end.
 *
 * parts: {name: async ({repeat, scale, options}) => {rows, goals, text}}; bounds in ms times `scale`
 * hold here. Without a text the rows are told as `table` does.
 * more: [{name, type, usage}], options of this bench alone
 */
export function runParts(bench, purpose, parts, more = []) {
  return runBench(bench, async (words) => {
    const names = Object.keys(parts);
    const options = readOptions(words, usage(bench, purpose, names, more), {
      ...Object.fromEntries(more.map(({ name, type }) => [name, { type }])),
      only: { type: 'string', default: names.join() },
      repeat: { type: 'string', default: '5' },
      json: { type: 'string' },
      check: { type: 'boolean', default: false },
    });
    if (options === null) return;
    const repeat = wholeNumber('--repeat', options.repeat, 1);
    const wanted = options.only.split(',').map((name) => oneOf('--only', name, names));
    const file = rowsFile(options.json);
    const scale = await machineScale(repeat);
    const rows = [];
    const goals = [];
    for (const name of wanted) {
      const part = await parts[name]({ repeat, scale, options });
      if (process.stderr.isTTY) tell('');
      console.log(`${name}: ${part.text ?? described(part.rows)}\n`);
      rows.push(...part.rows);
      goals.push(...part.goals);
      file.write(rows);
    }
    for (const { line } of goals) console.log(line);
    if (options.check && goals.some(({ ok }) => !ok)) process.exitCode = 1;
  });
}
