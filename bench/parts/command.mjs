// The native command, asked in words and scenes, and what it answers.
import { execFileSync, spawn, spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';

import { root } from './assets.mjs';
import { BadInput } from './bench-options.mjs';

const kMaxOutput = 2 ** 30; // [bytes]; positions are printed as text

export const command = join(root, 'build', 'release', 'cli', 'pleat');
export const cacheFolder = join(root, 'build', 'references');

/** Source that is measured, for the rows. */
export const commit = (() => {
  const words = ['-C', root, 'describe', '--always', '--dirty'];
  return spawnSync('git', words, { encoding: 'utf8' }).stdout?.trim() || 'unknown';
})();

/** Does `work` with a folder that is gone afterwards. */
export function inFolder(work) {
  const folder = mkdtempSync(join(tmpdir(), 'pleat-bench-'));
  const drop = () => rmSync(folder, { recursive: true });
  let result;
  try {
    result = work(folder);
  } catch (error) {
    drop();
    throw error;
  }
  if (result instanceof Promise) return result.finally(drop);
  drop();
  return result;
}

/** Words for the command: texts and numbers, and in the place of objects files that hold them. */
export const withFiles = (words, work) =>
  inFolder((folder) => {
    let count = 0;
    const text = (word) => {
      if (Array.isArray(word)) return word.map(text).join();
      if (typeof word !== 'object') return String(word);
      const path = join(folder, `${count++}.json`);
      writeFileSync(path, JSON.stringify(word));
      return path;
    };
    return work(words.map(text));
  });

/**
 * Exit status and output; words as of withFiles. Status 1 is an answer too: a run that ended early,
 * or a check that failed. Bad input has been told by the command itself, or is by `stderr` "pipe".
 */
export function ran(words, stderr = 'inherit') {
  const options = { encoding: 'utf8', maxBuffer: kMaxOutput, stdio: ['ignore', 'pipe', stderr] };
  const run = withFiles(words, (texts) => spawnSync(command, texts, options));
  if (run.status === 2) throw new BadInput(run.stderr?.trim() ?? '');
  if (run.error || run.status > 1 || run.status === null)
    throw run.error ?? new Error(`pleat ${words[0]}: exit status ${run.status ?? run.signal}`);
  return run;
}

export function printed(...words) {
  const { stdout } = ran(words);
  if (stdout === '') throw new Error(`pleat ${words[0]}: no answer`);
  return stdout;
}

export const ask = (...words) => JSON.parse(printed(...words));

/** Rows, a line each. What was not measured is NaN, with which no goal is met. */
export function askRows(...words) {
  const orNaN = (_, value) => (value === null ? Number.NaN : value);
  const lines = printed(...words).trim();
  return lines.split('\n').map((line) => JSON.parse(line, orNaN));
}

/** Lines of JSON that a program of the page's package prints. */
export function askPage(script) {
  const options = { cwd: join(root, 'web'), encoding: 'utf8' };
  const lines = execFileSync('npm', ['run', '--silent', script], options).split('\n');
  return lines.filter((line) => line.startsWith('{')).map((line) => JSON.parse(line));
}

/**
 * Positions that are taken for right: `kind` is "rigid_chain", "closed_form", or "run" for the
 * scene's own method; runs are kept in build/references.
 */
export function reference(scene, kind, times, options = []) {
  const words = ['--kind', kind, '--times', times, '--cache', cacheFolder, ...options];
  return ask('bench', 'reference', scene, ...words);
}

const runWords = (scene, frames, times, options) => [
  ...['bench', 'run', scene, '--frames', frames],
  ...(times.length ? ['--times', times] : []),
  ...options,
];

/** A whole run of the scene, its first frame not timed. */
export const nativeRun = (scene, frames, times = [], options = []) =>
  ask(...runWords(scene, frames, times, options));

/** A run in turns: its state is built and its first frame has been run. */
export function nativeTurns(scene, frames, times, options = []) {
  return new Promise((begin, fail) => {
    const ended = withFiles(
      runWords(scene, frames, times, ['--turns', ...options]),
      (texts) =>
        new Promise((resolve, reject) => {
          const child = spawn(command, texts, { stdio: ['pipe', 'pipe', 'pipe'] });
          let told = '';
          let record = null;
          let turnDone = null;
          const advance = (count) =>
            new Promise((done) => {
              turnDone = done;
              if (record) done();
              else child.stdin.write(`${count}\n`);
            });
          child.stdin.on('error', () => undefined); // the run may have ended
          child.stderr.on('data', (text) => (told += text));
          createInterface({ input: child.stdout }).on('line', (line) => {
            if (line !== 'ready') record = JSON.parse(line);
            begin({ advance, finish: () => ended });
            turnDone?.();
          });
          child.on('error', reject);
          child.on('close', () => (record ? resolve(record) : reject(new Error(told))));
        }),
    );
    ended.catch(fail);
  });
}
