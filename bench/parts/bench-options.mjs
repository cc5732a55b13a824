// The words after a bench's name, and the file that its rows go to. What cannot be used is one
// sentence, before anything is measured.
import { closeSync, openSync, writeFileSync } from 'node:fs';
import { parseArgs } from 'node:util';

/** Their input is at fault: told in one sentence (if it is not told yet), exit status 2. */
export class BadInput extends Error {}

/** Progress, on stderr. */
export function tell(text) {
  process.stderr.write(process.stderr.isTTY ? `\r\x1b[K${text}` : `${text}\n`);
}

/** "ENOENT: no such file or directory", without the call and the path. */
export const reasonOf = (error) => error.message.split(', ')[0];

/**
 * Values of options, which are all texts or flags, and at most `most` further words.
 *
 * types: {name: 'string' or 'boolean'}
 */
export function readOptions(words, types, most) {
  const known = Object.entries(types).map(([name, type]) => [name, { type }]);
  const { values, positionals, tokens } = parseArgs({
    args: words,
    options: { ...Object.fromEntries(known), help: { type: 'boolean', short: 'h' } },
    allowPositionals: true,
    strict: false,
    tokens: true,
  });
  for (const { kind, name, rawName, value } of tokens) {
    if (kind !== 'option') continue;
    const names = Object.keys(types).map((option) => `--${option}`);
    if (!types[name]) throw new BadInput(`${rawName}: expected one of ${names.join(', ')}`);
    if (types[name] === 'string' && value === undefined)
      throw new BadInput(`${rawName}: expected a value, got none`);
    if (types[name] === 'boolean' && value !== undefined)
      throw new BadInput(`${rawName}: expected no value, got "${value}"`);
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

/** Writes rows as JSON lines to a file; without one nowhere. It is opened before anything runs. */
export function rowsFile(file) {
  if (file === undefined) return { write: () => undefined };
  const must = (work) => {
    try {
      work();
    } catch (error) {
      throw new BadInput(`--json ${file}: expected a file to write to, got ${reasonOf(error)}`);
    }
  };
  must(() => closeSync(openSync(file, 'a')));
  const text = (rows) => rows.map((row) => `${JSON.stringify(row)}\n`).join('');
  return { write: (rows) => must(() => writeFileSync(file, text(rows))) };
}
