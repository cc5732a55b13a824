// The native command, asked in words and scenes, and what it answers.
import { execFileSync, spawn } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';

import { BadInput } from './bench-options.mjs';

const kMaxOutput = 2 ** 30; // [bytes]; positions are printed as text

export const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..');
export const command = join(root, 'build', 'release', 'cli', 'pleat');
export const cacheFolder = join(root, 'build', 'references');

/** Words for the command: texts and numbers, and in the place of objects files that hold them. */
export function withFiles(words, work) {
  const folder = mkdtempSync(join(tmpdir(), 'pleat-bench-'));
  const drop = () => rmSync(folder, { recursive: true });
  let count = 0;
  const file = (object) => {
    const path = join(folder, `${count++}.json`);
    writeFileSync(path, JSON.stringify(object));
    return path;
  };
  const text = (word) =>
    Array.isArray(word) ? word.map(text).join() : typeof word === 'object' ? file(word) : word;
  let result;
  try {
    result = work(words.map((word) => String(text(word))));
  } catch (error) {
    drop();
    throw error;
  }
  if (result instanceof Promise) return result.finally(drop);
  drop();
  return result;
}

/**
 * What the command prints; words as of withFiles. Status 1 is an answer too: a run that ended
 * early. Bad input has been told by the command itself.
 */
export function printed(...words) {
  const options = { encoding: 'utf8', maxBuffer: kMaxOutput, stdio: ['ignore', 'pipe', 'inherit'] };
  try {
    return withFiles(words, (texts) => execFileSync(command, texts, options));
  } catch (error) {
    if (error.status === 2) throw new BadInput('');
    if (error.status === 1 && error.stdout) return error.stdout;
    throw error;
  }
}

export const ask = (...words) => JSON.parse(printed(...words));

/** Rows, a line each. What was not measured is NaN, with which no goal is met. */
export function askRows(...words) {
  const lines = printed(...words)
    .trim()
    .split('\n');
  const orNaN = (_, value) => (value === null ? Number.NaN : value);
  return lines.map((line) => JSON.parse(line, orNaN));
}

/** What a program of the page's package prints: its lines of JSON. */
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

/** A whole run of the scene, its first frame not timed. */
export function nativeRun(scene, frames, times = [], options = []) {
  const wanted = times.length ? ['--times', times] : [];
  return ask('bench', 'run', scene, '--frames', frames, ...wanted, ...options);
}

/** The same in turns: its state is built and its first frame has been run. */
export function nativeTurns(scene, frames, times, options = []) {
  const wanted = times.length ? ['--times', times] : [];
  const words = ['bench', 'run', scene, '--frames', frames, '--turns', ...wanted, ...options];
  return new Promise((begin, fail) => {
    const ended = withFiles(
      words,
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
          child.stdin.on('error', () => undefined); // of a run that has ended
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
