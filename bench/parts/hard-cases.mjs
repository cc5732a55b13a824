// Every hard case with every stepper, and how many ended as they should not.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { BadInput } from './bench-options.mjs';
import { goal, markdown } from './bench-rows.mjs';
import { command, root } from './command.mjs';

const kScenes = join(root, 'assets', 'hard_cases');

/** What the command says of each; exit status 1 is an answer too. */
function outcomes(words) {
  const folder = mkdtempSync(join(tmpdir(), 'pleat-hard-cases-'));
  const file = join(folder, 'outcomes.jsonl');
  try {
    const all = ['hard-cases', '--scenes', kScenes, '--json', file, ...words];
    const { status } = spawnSync(command, all, { stdio: ['ignore', 'ignore', 'inherit'] });
    if (status !== 0 && status !== 1) throw new BadInput('');
    return readFileSync(file, 'utf8')
      .trim()
      .split('\n')
      .map((line) => JSON.parse(line));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** How many outcomes have each status, and each that is not as it should be. */
function told(rows, unexpected) {
  const statuses = [...new Set(rows.map((row) => row.status))];
  const counts = statuses.map((status) => [
    status,
    rows.filter((row) => row.status === status).length,
    unexpected.filter((row) => row.status === status).length,
  ]);
  const faults = unexpected.map(({ case: name, stepper, sentence }) => [name, stepper, sentence]);
  return [
    markdown(['status', 'outcomes', 'unexpected'], counts),
    ...(faults.length ? [markdown(['case', 'stepper', 'what was not kept'], faults)] : []),
  ].join('\n\n');
}

export async function hardCases({ options }) {
  const rows = outcomes(options.short ? ['--short'] : []);
  const unexpected = rows.filter((row) => !row.expected);
  return {
    rows,
    goals: [goal('stability.hard_cases.unexpected', unexpected.length, 'at-most', 0)],
    text: `what breaks cloth systems\n\n${told(rows, unexpected)}`,
  };
}
