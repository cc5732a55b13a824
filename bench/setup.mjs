// What a newcomer waits for: the page, the tests, and one changed source. In a fresh clone of HEAD outside the
// tree, on two cores, with every source compiled anew. Debian's packages and Node are there already.
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
import { oneOf, readOptions, rowsFile, runBench } from './parts/bench-options.mjs';
import { goal, markdown, short } from './parts/bench-rows.mjs';
import { root } from './parts/command.mjs';

const kPort = 4873;
const kAddress = `http://127.0.0.1:${kPort}/`;
const kPollMs = 200;

/** Sources that a change is timed at, the longest to compile of three modules. */
const kChanges = {
  mesh: 'quad_mesh.cpp',
  dynamics: 'stepper_newton.cpp',
  scene: 'cloth_section.cpp',
};

const usage = `./pleat bench setup   seconds from a fresh clone to the page, to the end of all tests, and after a change
  --only PART,...   of page, test, change (default: all)
  --json FILE       write the rows as JSON lines
  --check           exit status 1 when a goal is short
Exit status: 0 done, 1 a goal is short (with --check), 2 bad input.`;

/** Without a compiler cache, whichever way it is called. */
function coldEnvironment() {
  const env = { ...process.env, CCACHE_DISABLE: '1' };
  delete env.CMAKE_C_COMPILER_LAUNCHER;
  delete env.CMAKE_CXX_COMPILER_LAUNCHER;
  const folders = env.PATH.split(delimiter);
  env.PATH = folders.filter((folder) => !folder.includes('ccache')).join(delimiter);
  return env;
}

/** A clone of HEAD that finds this checkout's Node. */
function freshClone(scratch) {
  const clone = join(scratch, 'pleat');
  execFileSync('git', ['clone', '--quiet', root, clone]);
  symlinkSync(join(root, '.tools'), join(clone, '.tools'));
  return clone;
}

/** Starts ./pleat in the clone, on two cores, in a process group of its own. Its output goes to `log`. */
function startPleat(clone, words, log) {
  const onTwoCores = cpus().length > 2 ? ['taskset', '-c', '0,1'] : [];
  const [program, ...rest] = [...onTwoCores, './pleat', ...words];
  const output = openSync(log, 'w');
  const child = spawn(program, rest, {
    cwd: clone,
    env: coldEnvironment(),
    stdio: ['ignore', output, output],
    detached: true,
  });
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
async function timed(part, log, work) {
  process.stderr.write(`${part}\n`);
  const begin = performance.now();
  const ok = await work();
  const seconds = (performance.now() - begin) / 1000;
  if (!ok) process.stderr.write(readFileSync(log, 'utf8'));
  return { part, seconds, status: ok ? 'ok' : 'failed' };
}

function timedPleat(part, clone, words, log) {
  return timed(part, log, async () => (await startPleat(clone, words, log).ended) === 0);
}

async function page(clone, log) {
  const { child, ended } = startPleat(clone, ['demo', '--port', String(kPort)], log);
  let running = true;
  ended.then(() => {
    running = false;
  });
  const row = await timed('page', log, async () => {
    while (running && !(await answers())) await sleep(kPollMs);
    return running;
  });
  if (running) process.kill(-child.pid, 'SIGTERM');
  await ended;
  return { rows: [row], goal: goal('setup.page_s', row.seconds, 'at-most', 240, [row]) };
}

async function test(clone, log) {
  const row = await timedPleat('test', clone, ['test'], log);
  return { rows: [row], goal: goal('setup.test_s', row.seconds, 'at-most', 1200, [row]) };
}

/** Each module is built and tested once before its source changes. */
async function change(clone, log) {
  const rows = [];
  for (const [module, file] of Object.entries(kChanges)) {
    await startPleat(clone, ['test', module], log).ended;
    appendFileSync(join(clone, 'core', module, file), '// Changed.\n');
    rows.push(await timedPleat(`change of core/${module}/${file}`, clone, ['test', module], log));
  }
  const longest = Math.max(...rows.map((row) => row.seconds));
  return { rows, goal: goal('setup.change_s', longest, 'at-most', 60, rows) };
}

const kParts = { page, test, change };

await runBench('setup', async (words) => {
  const names = Object.keys(kParts);
  const options = readOptions(words, usage, {
    only: { type: 'string', default: names.join() },
    json: { type: 'string' },
    check: { type: 'boolean', default: false },
  });
  if (options === null) return;
  const wanted = options.only.split(',').map((name) => oneOf('--only', name, names));
  const file = rowsFile(options.json);
  const scratch = mkdtempSync(join(tmpdir(), 'pleat-setup-'));
  try {
    const clone = freshClone(scratch);
    const rows = [];
    const goals = [];
    for (const name of wanted) {
      const part = await kParts[name](clone, join(scratch, 'log'));
      rows.push(...part.rows);
      goals.push(part.goal);
      file.write(rows);
    }
    const lines = rows.map(({ part, seconds, status }) => [part, short(seconds), status]);
    console.log(`${markdown(['part', 'seconds', 'status'], lines)}\n`);
    for (const { line } of goals) console.log(line);
    if (options.check && goals.some(({ ok }) => !ok)) process.exitCode = 1;
  } finally {
    rmSync(scratch, { recursive: true, force: true });
  }
});
