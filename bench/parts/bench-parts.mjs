// A bench in parts: its options, the yardstick that scales bounds in milliseconds, what it prints.
import { BadInput, oneOf, readOptions, rowsFile, tell, wholeNumber } from './bench-options.mjs';
import { described, median, sideBySide } from './bench-rows.mjs';
import { loopContestant, warmUpLoop } from './plain-loop.mjs';

const kYardstickMs = 20; // time on the machine that the bounds in ms are made for

/** Milliseconds of the yardstick here, over those that the bounds were made for. */
async function machineScale(repeat) {
  const kFrames = 30;
  const kSubsteps = 100;
  const yardstick = loopContestant('yardstick', 65, kSubsteps, {}, kFrames);
  warmUpLoop();
  const [runs] = await sideBySide([yardstick], { repeat, frames: kFrames });
  const ms = median(runs.map((run) => median(run.ms)));
  const nsPerConstraint = (1e6 * ms) / (kSubsteps * runs[0].n_constraints);
  console.log(
    `yardstick 65x65, ${kSubsteps} substeps, rows: ${ms.toFixed(2)} ms, ${nsPerConstraint.toFixed(2)} ns per constraint;`,
  );
  console.log(`bounds in ms are scaled by ${(ms / kYardstickMs).toFixed(3)}\n`);
  return ms / kYardstickMs;
}

const kRepeat = { '--repeat N': 'runs of each contestant, in turn (default 5)' };

function usageOf(bench, purpose, parts, options) {
  const known = {
    '--only PART,...': `of ${parts.join(', ')} (default: all)`,
    ...options,
    '--json FILE': 'write the rows as JSON lines',
    '--check': 'exit status 1 when a goal is short',
  };
  const lines = Object.entries(known).map(([words, meaning]) => `  ${words.padEnd(18)}${meaning}`);
  const text = `./pleat bench ${bench}   ${purpose}
${lines.join('\n')}
Exit status: 0 done, 1 a goal is short (with --check), 2 bad input.`;
  const types = Object.keys(known).map((words) => {
    const [option, value] = words.split(' ');
    return [option.slice(2), value ? 'string' : 'boolean'];
  });
  return { text, types: { ...Object.fromEntries(types), help: 'boolean' } };
}

/** Runs parts and tells each when it is over; returns their goals, which are told at the end. */
async function tellParts(parts, names, file, settings) {
  const rows = [];
  const goals = [];
  for (const name of names) {
    const part = await parts[name](settings);
    if (process.stderr.isTTY) tell('');
    console.log(`${name}: ${part.text ?? described(part.rows)}\n`);
    rows.push(...part.rows);
    goals.push(...part.goals);
    file.write(rows);
  }
  const all = settings.overall?.(rows);
  if (all) {
    console.log(`${all.text}\n`);
    goals.push(...all.goals);
  }
  for (const { line } of goals) console.log(line);
  return goals;
}

/**
 * Runs the parts that the command line asks for and prints what they found. Bugs of a bench keep
 * their stack trace.
 *
 * parts: {name: async ({repeat, scale, options}) => {rows, goals, text}}; bounds in ms times `scale`
 * hold here. Without a text the rows are told as `described` does.
 * more: {'--name VALUE': meaning}, options of this bench alone
 * isScaled: whether the yardstick is timed and parts are repeated
 * most: how many words it takes beside options
 * overall: (rows of all parts) => {text, goals}, told after them
 */
export async function runParts(
  bench,
  purpose,
  parts,
  { more = {}, isScaled = true, most = 0, overall } = {},
) {
  try {
    const names = Object.keys(parts);
    const usage = usageOf(bench, purpose, names, { ...(isScaled && kRepeat), ...more });
    const options = readOptions(process.argv.slice(2), usage.types, most);
    if (options.help) {
      console.log(usage.text);
      return;
    }
    const repeat = wholeNumber('--repeat', options.repeat ?? '5', 1);
    const wanted = (options.only ?? names.join()).split(',');
    for (const name of wanted) oneOf('--only', name, names);
    const file = rowsFile(options.json);
    const scale = isScaled ? await machineScale(repeat) : 1;
    const goals = await tellParts(parts, wanted, file, { repeat, scale, options, overall });
    if (options.check && goals.some(({ ok }) => !ok)) process.exitCode = 1;
  } catch (error) {
    if (!(error instanceof BadInput)) throw error;
    if (error.message) console.error(`bench ${bench}: ${error.message}`);
    process.exitCode = 2;
  }
}
