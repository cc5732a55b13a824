// ./pleat bench setup (--help tells the options)
// A newcomer's waits: for the page, the tests, and one changed source. In a fresh clone of HEAD
// outside the tree, on two cores, with every source compiled anew. Debian's packages and Node are
// there already. And what a visitor downloads, and how many places a change has to touch.
import { execFileSync, spawn } from 'node:child_process';
import {
  appendFileSync,
  closeSync,
  existsSync,
  mkdtempSync,
  openSync,
  readdirSync,
  readFileSync,
  rmSync,
  statSync,
  symlinkSync,
} from 'node:fs';
import { cpus, tmpdir } from 'node:os';
import { delimiter, join } from 'node:path';
import { setTimeout as sleep } from 'node:timers/promises';
import { brotliCompressSync, gzipSync } from 'node:zlib';

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

/** Path in the clone where a part has made it, else in this checkout. */
function built(...path) {
  const inClone = scratch && join(scratch, 'pleat', ...path);
  return inClone && existsSync(inClone) ? inClone : join(root, ...path);
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
  return found([row], 'page_s', 200);
}

const test = async () => {
  freshClone();
  return found([await timedPleat('test', ['test'])], 'test_s', 18 * 60);
};

/** Each module is built and tested once before its source changes. */
async function change() {
  const rows = [];
  for (const [module, file] of Object.entries(kChanges)) {
    await startPleat(['test', module]).ended;
    appendFileSync(join(freshClone(), 'core', module, file), '// Changed.\n');
    rows.push(await timedPleat(`change of core/${module}/${file}`, ['test', module]));
  }
  return found(rows, 'change_s', 60);
}

/** Texts of the last build's and tests' logs whose names begin so, the newest first. */
function logs(start) {
  const folder = built('build', 'logs');
  const names = existsSync(folder) ? readdirSync(folder) : [];
  return names
    .filter((name) => name.startsWith(start) && name.endsWith('.log'))
    .map((name) => join(folder, name))
    .sort((a, b) => statSync(b).mtimeMs - statSync(a).mtimeMs)
    .map((file) => readFileSync(file, 'utf8'))
    .join('\n');
}

/** Kilobytes gzipped that the build of the page tells of what a first visit runs. */
const pageCode = () => Number(logs('page-build').match(/first load, page: ([\d.]+) kB/)?.[1]);

/**
 * Kilobytes of WebAssembly and of the page. Views that are opened later fetch the rest of the module.
 */
function download() {
  const folder = [built('web', 'dist', 'assets'), built('build', 'wasm', 'wasm')].find(existsSync);
  const files = folder ? readdirSync(folder).filter((name) => /^pleat\b.*\.wasm$/.test(name)) : [];
  const modules = files.map((file) => {
    const bytes = readFileSync(join(folder, file));
    const [gzip_kb, brotli_kb] = [gzipSync, brotliCompressSync].map(
      (pack) => pack(bytes).length / 1e3,
    );
    return { file, gzip_kb, brotli_kb, status: 'ok' };
  });
  const sum = (file, rows) => {
    const of = (key) => rows.reduce((total, row) => total + row[key], 0) || Number.NaN;
    return { file, gzip_kb: of('gzip_kb'), brotli_kb: of('brotli_kb'), status: 'ok' };
  };
  const first = modules.filter(({ file }) => !file.startsWith('pleat-rest'));
  const totals = [
    sum('WebAssembly of a first visit', first),
    sum('all WebAssembly', modules),
    { file: "a first visit's page", gzip_kb: pageCode(), status: 'ok' },
  ];
  const [visit, all, page] = totals.map((row) => row.gzip_kb);
  const rows = [...modules, ...totals];
  const columns = { file: 'file', 'gzip kB': 'gzip_kb', 'Brotli kB': 'brotli_kb' };
  return {
    rows,
    goals: [
      atMost('first_visit_wasm_kb', visit, 600),
      atMost('first_visit_page_kb', page, 200),
      atMost('all_wasm_kb', all, 1000),
    ],
    text: `\n\n${table(rows, columns)}`,
  };
}

/** Most places that are touched for one more of each. */
const kPlaces = { method_setting: 5, collider: 8, subcommand: 2 };

/** Places that tests with made-up things have counted: lines "places NAME NUMBER" of their logs. */
function places() {
  const texts = logs('');
  const rows = Object.keys(kPlaces).map((what) => {
    const count = texts.match(new RegExp(`^places ${what} (\\d+)$`, 'm'))?.[1];
    return { what, places: count && Number(count), status: count ? 'ok' : 'not counted' };
  });
  const goals = rows.map((row) =>
    atMost(`${row.what}_places`, row.places, kPlaces[row.what], [row]),
  );
  const columns = { 'one more': 'what', places: 'places', status: 'status' };
  return { rows, goals, text: `\n\n${table(rows, columns)}` };
}

const purpose =
  'seconds from a fresh clone to the page, to the end of all tests, and after a change; downloads; places to touch';
const parts = { page, test, change, download, places };
await runParts('setup', purpose, parts, { isScaled: false });
