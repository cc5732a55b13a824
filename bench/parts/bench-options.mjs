// The words after a bench's name, and the file that its rows go to. What cannot be used is one
// sentence, before anything is measured.
import { closeSync, existsSync, openSync, unlinkSync, writeFileSync } from 'node:fs';
import { parseArgs } from 'node:util';

/** Their input is at fault: told in one sentence (if it is not told yet), exit status 2. */
export class BadInput extends Error {}

/** "ENOENT: no such file or directory", without the call and the path. */
export function reasonOf(error) {
  return error.message.split(', ')[0];
}

/**
 * Values of the known `options` (as of node:util parseArgs) and at most `most` further words. Null
 * when --help was asked for and `usage` printed.
 */
export function readOptions(words, usage, options, most = 0) {
  const known = { ...options, help: { type: 'boolean', short: 'h' } };
  const { values, positionals, tokens } = parseArgs({
    args: words,
    options: known,
    allowPositionals: true,
    strict: false,
    tokens: true,
  });
  for (const { kind, name, rawName, value } of tokens) {
    if (kind !== 'option') continue;
    const names = Object.keys(known).map((option) => `--${option}`);
    if (!known[name]) throw new BadInput(`${rawName}: expected one of ${names.join(', ')}`);
    const wantsValue = known[name].type === 'string';
    if (wantsValue && value === undefined)
      throw new BadInput(`${rawName}: expected a value, got none`);
    if (!wantsValue && value !== undefined)
      throw new BadInput(`${rawName}: expected no value, got "${value}"`);
  }
  if (values.help) {
    console.log(usage);
    return null;
  }
  if (positionals.length > most)
    throw new BadInput(`expected at most ${most} words beside options, got "${positionals[most]}"`);
  return { ...values, words: positionals };
}

export function wholeNumber(option, text, least) {
  if (!/^\d{1,9}$/.test(text) || Number(text) < least)
    throw new BadInput(`${option}: expected a whole number of at least ${least}, got "${text}"`);
  return Number(text);
}

export function oneOf(option, text, choices) {
  if (!choices.includes(text))
    throw new BadInput(`${option}: expected one of ${choices.join(', ')}, got "${text}"`);
  return text;
}

function mustWrite(file, work) {
  try {
    return work();
  } catch (error) {
    throw new BadInput(`--json ${file}: expected a file to write to, got ${reasonOf(error)}`);
  }
}

/** Where rows are written as JSON lines; without a file nowhere. Probed here, changed by `write`. */
export function rowsFile(file) {
  if (file === undefined) return { write: () => undefined };
  mustWrite(file, () => {
    const existed = existsSync(file);
    closeSync(openSync(file, 'a'));
    if (!existed) unlinkSync(file);
  });
  return {
    write(rows) {
      const text = rows.map((row) => `${JSON.stringify(row)}\n`).join('');
      mustWrite(file, () => writeFileSync(file, text));
    },
  };
}

/** Runs a bench on the words of the command line. Its own bugs keep their stack trace. */
export async function runBench(name, work) {
  try {
    await work(process.argv.slice(2));
  } catch (error) {
    if (!(error instanceof BadInput)) throw error;
    if (error.message) console.error(`bench ${name}: ${error.message}`);
    process.exitCode = 2;
  }
}
