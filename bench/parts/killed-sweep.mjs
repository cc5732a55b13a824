// A sweep that is killed and started again: what its journal and its rows have lost or repeated.
import { spawn } from 'node:child_process';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { tell } from './bench-options.mjs';
import { atMost, table } from './bench-rows.mjs';
import { command, inFolder } from './command.mjs';

const kPollMs = 1;
const kRepeats = 2;
const kSteppers = ['implicit', 'xpbd'];
const kSubsteps = 15; // counts of each stepper, from 1 on
const kSettings = kSteppers.length * kSubsteps;
const kRuns = kSettings * (1 + kRepeats);
// Half way through the settings, and half way through all runs, within a timed round.
const kKills = [kSettings / 2, kRuns / 2];

const wholeLines = (file) =>
  existsSync(file) ? readFileSync(file, 'utf8').split('\n').slice(0, -1) : [];

/**
 * Runs missing from the whole journal of a sweep, and runs in it twice or other than they stood
 * there at a kill.
 *
 * kills: the journal's lines at each kill; lines: at the end; runs: how many there are
 */
export function journalFaults(kills, lines, runs) {
  const keys = lines.map((line) => {
    const { setting, round } = JSON.parse(line);
    return `${setting} ${round}`;
  });
  const isChanged = (line, i) => line !== lines[i];
  const changed = kills.map((known) => known.filter(isChanged).length);
  const different = new Set(keys).size;
  return { lost: runs - different, repeated: keys.length - different + Math.max(0, ...changed) };
}

/** Rows that settings lack or have too many of. */
export function rowFaults(settings, rows) {
  const key = (setting) => JSON.stringify(Object.entries(setting).sort());
  const different = new Set(rows.map((row) => key(row.setting)));
  return {
    lost: settings.filter((setting) => !different.has(key(setting))).length,
    repeated: rows.length - different.size,
  };
}

/** Runs the command, at most until the journal has so many lines; the signal that ended it. */
function sweepUntil(words, journal, lines) {
  return new Promise((resolve, reject) => {
    const child = spawn(command, words, { stdio: 'ignore' });
    const watch = setInterval(() => {
      if (wholeLines(journal).length >= lines) child.kill('SIGKILL');
    }, kPollMs);
    child.on('error', reject);
    child.on('close', (_, signal) => {
      clearInterval(watch);
      resolve(signal);
    });
  });
}

async function killAndGoOn(plan, folder) {
  const planFile = join(folder, 'plan.json');
  writeFileSync(planFile, JSON.stringify(plan));
  const out = join(folder, 'out');
  const words = ['sweep', planFile, '--json', '--out', out];
  const journal = join(out, 'runs.jsonl');
  const kills = [];
  let allKilled = true;
  for (const lines of kKills) {
    tell(`sweep, until ${lines} of ${kRuns} runs`);
    allKilled = (await sweepUntil(words, journal, lines)) === 'SIGKILL' && allKilled;
    kills.push(wholeLines(journal));
  }
  tell('sweep, to its end');
  await sweepUntil(words, journal, Number.POSITIVE_INFINITY);
  const rows = wholeLines(join(out, 'rows.jsonl')).map((line) => JSON.parse(line));
  return { allKilled, kills, lines: wholeLines(journal), rows };
}

/** `scene` with 30 settings, killed and continued twice. */
export async function killedSweep(scene) {
  const settings = kSteppers.flatMap((stepper) =>
    Array.from({ length: kSubsteps }, (_, s) => ({
      '/method/stepper': stepper,
      '/method/substeps': s + 1,
    })),
  );
  const plan = { scene, settings, duration_s: 1, repeats: kRepeats };
  const { allKilled, kills, lines, rows } = await inFolder((folder) => killAndGoOn(plan, folder));
  const faults = [journalFaults(kills, lines, kRuns), rowFaults(settings, rows)];
  const total = (kind) =>
    allKilled ? faults.reduce((sum, fault) => sum + fault[kind], 0) : Number.NaN;
  const killed = kills.map((known) => known.length).join(' and ');
  const columns = {
    method: (row) => row.method.stepper,
    substeps: 'n_substeps',
    'ms/frame': 'ms_per_frame',
    runs: 'n_runs',
    'position error mm': (row) => 1e3 * (row.position_error_m ?? Number.NaN),
    status: 'status',
  };
  return {
    rows,
    goals: [
      atMost('sweep_rows_lost', total('lost'), 0, rows),
      atMost('sweep_runs_repeated', total('repeated'), 0, rows),
    ],
    text: `killed after ${killed} of ${kRuns} runs; errors against ${rows[0]?.reference.description}\n\n${table(rows, columns)}`,
  };
}
