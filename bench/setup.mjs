// ./pleat bench setup (--help tells the options)
// A newcomer's waits: for the page, the tests, and one changed source. In a fresh clone of HEAD
// outside the tree, on two cores, with every source compiled anew. Debian's packages and Node are
// there already.
import { execFileSync, spawn } from 'node:child_process';
import {
  appendFileSync,
  closeSync,
  mkdtempSync,
  openSync,
  readFileSync,
  rmSync,
  symlinkSync,
} from 'node:fs';
import { cpus, tmpdir } from 'node:os';
import { delimiter, join } from 'node:path';
import { setTimeout as sleep } from 'node:timers/promises';

import { root } from './parts/assets.mjs';
import { tell } from './parts/bench-options.mjs';
import { runParts } from './parts/bench-parts.mjs';
import { atMost, table } from './parts/bench-rows.mjs';

const kPort = 4873;
const kAddress = `http://127.0.0.1:${kPort}/`;
const kPollMs = 200;

/** Sources that a change is timed at, the longest to compile of three modules. */
const kChanges = {
  mesh: 'quad_mesh.cpp',
  dynamics: 'stepper_newton.cpp',
  scene: 'cloth_section.cpp',
};

/** An environment without a compiler cache, whichever way it is called. */
function coldEnvironment() {
  const env = { ...process.env, CCACHE_DISABLE: '1' };
  delete env.CMAKE_C_COMPILER_LAUNCHER;
  delete env.CMAKE_CXX_COMPILER_LAUNCHER;
  const folders = env.PATH.split(delimiter);
  env.PATH = folders.filter((folder) => !folder.includes('ccache')).join(delimiter);
  return env;
}

let scratch = null;

/** A clone of HEAD that finds this checkout's Node, one for all parts. */
function freshClone() {
  if (!scratch) {
    scratch = mkdtempSync(join(tmpdir(), 'pleat-setup-'));
    process.on('exit', () => rmSync(scratch, { recursive: true, force: true }));
    execFileSync('git', ['clone', '--quiet', root, join(scratch, 'pleat')]);
    symlinkSync(join(root, '.tools'), join(scratch, 'pleat', '.tools'));
  }
  return join(scratch, 'pleat');
}

const logFile = () => join(scratch, 'log');

/** Starts ./pleat in the clone, on two cores, in a process group of its own. */
function startPleat(words) {
  const cwd = freshClone();
  const onTwoCores = cpus().length > 2 ? ['taskset', '-c', '0,1'] : [];
  const [program, ...rest] = [...onTwoCores, './pleat', ...words];
  const output = openSync(logFile(), 'w');
  const stdio = ['ignore', output, output];
  const child = spawn(program, rest, { cwd, env: coldEnvironment(), stdio, detached: true });
  closeSync(output);
  const ended = new Promise((resolve) => {
    child.on('error', () => resolve(1));
    child.on('exit', (status) => resolve(status ?? 1));
  });
  return { child, ended };
}

async function answers() {
  try {
    return (await fetch(kAddress)).ok;
  } catch {
    return false;
  }
}

/** Runs `work` and makes a row of how long it took; it returns whether all went well. */
async function timed(part, work) {
  tell(part);
  const begin = performance.now();
  const ok = await work();
  const seconds = (performance.now() - begin) / 1000;
  if (!ok) process.stderr.write(readFileSync(logFile(), 'utf8'));
  return { part, seconds, status: ok ? 'ok' : 'failed' };
}

const timedPleat = (part, words) => timed(part, async () => (await startPleat(words).ended) === 0);

/** The slowest row is promised. */
function found(rows, name, bound) {
  const slowest = Math.max(...rows.map((row) => row.seconds));
  const columns = { part: 'part', seconds: 'seconds', status: 'status' };
  return { rows, goals: [atMost(name, slowest, bound, rows)], text: `\n\n${table(rows, columns)}` };
}

async function page() {
  freshClone();
  const { child, ended } = startPleat(['demo', '--port', kPort]);
  let running = true;
  ended.then(() => {
    running = false;
  });
  const row = await timed('page', async () => {
    while (running && !(await answers())) await sleep(kPollMs);
    return running;
  });
  if (running) process.kill(-child.pid, 'SIGTERM');
  await ended;
  return found([row], 'setup.page_s', 240);
}

const test = async () => {
  freshClone();
  return found([await timedPleat('test', ['test'])], 'setup.test_s', 1200);
};

/** Each module is built and tested once before its source changes. */
async function change() {
  const rows = [];
  for (const [module, file] of Object.entries(kChanges)) {
    await startPleat(['test', module]).ended;
    appendFileSync(join(freshClone(), 'core', module, file), '// Changed.\n');
    rows.push(await timedPleat(`change of core/${module}/${file}`, ['test', module]));
  }
  return found(rows, 'setup.change_s', 60);
}

const purpose =
  'seconds from a fresh clone to the page, to the end of all tests, and after a change';
const parts = { page, test, change };
await runParts('setup', purpose, parts, { isScaled: false });
