// Holds every import of src against LAYERS, and finds imports that lead back to where they began.
// A violation is printed as "file:line: sentence"; the exit status is then 1.
// --self-test plants one violation of every kind in a scratch tree and expects each to be found.
import {
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, dirname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('..', import.meta.url));

/** A file of src names another by such a text, in an import, a worker's address or a style sheet. */
const RELATIVE = /(['"`])(\.\.?\/[^'"`$*]*)\1/g;
const PACKAGE = /\b(?:from|import) '([a-z@][^']*)'/g;

interface Rules {
  /** Height of each room by its name, those of shared/ and those inside views. */
  shared: Map<string, number>;
  rooms: Map<string, number>;
  top: string[];
  only: { what: string; places: string[] }[];
}

interface Import {
  from: string;
  line: number;
  /** A path in src, or the name of a package. */
  to: string;
  isPackage: boolean;
}

/** Where a file belongs: its view, or shared, and the room there; null for files in no folder. */
interface Place {
  owner: string;
  room: string;
}

function readRules(text: string): Rules {
  const rules: Rules = { shared: new Map(), rooms: new Map(), top: [], only: [] };
  text.split('\n').forEach((line, index) => {
    const [kind, ...words] = line.replace(/#.*/, '').trim().split(/\s+/);
    if (kind === '') return;
    const split = words.indexOf('in');
    if (kind === 'shared') for (const word of words) rules.shared.set(word, index);
    else if (kind === 'room') for (const word of words) rules.rooms.set(word, index);
    else if (kind === 'top') rules.top.push(...words);
    else if (kind === 'only' && split > 0)
      for (const what of words.slice(0, split))
        rules.only.push({ what, places: words.slice(split + 1) });
    else throw new Error(`LAYERS:${index + 1}: no rule is written like this: ${line}`);
  });
  return rules;
}

function placeOf(file: string): Place | null {
  const [owner, ...inner] = file.split('/').slice(0, -1);
  return owner === undefined ? null : { owner, room: inner.join('/') };
}

/** The file of src that is meant, or null when it is none. */
function resolveIn(src: string, from: string, text: string): string | null {
  const path = normalize(join(dirname(from), text));
  if (path.startsWith('..')) return null;
  if (path.startsWith('wasm/')) return path; // made by the build
  const found = ['', '.ts', '.d.ts'].find(
    (ending) => /\.\w+$/.test(path + ending) && existsSync(join(src, path + ending)),
  );
  return found === undefined ? null : path + found;
}

function importsOf(src: string, from: string): Import[] {
  const lines = readFileSync(join(src, from), 'utf8').split('\n');
  return lines.flatMap((text, index): Import[] => {
    if (/^\s*(\/\/|\*|\/\*)/.test(text)) return [];
    const line = index + 1;
    const own = [...text.matchAll(RELATIVE)].flatMap(
      ([, , path = '']) => resolveIn(src, from, path) ?? [],
    );
    const packages = [...text.matchAll(PACKAGE)].map(([, name = '']) => name);
    return [
      ...own.map((to) => ({ from, line, to, isPackage: false })),
      ...packages.map((to) => ({ from, line, to, isPackage: true })),
    ];
  });
}

function reservedSentence(
  { only }: Rules,
  from: Place | null,
  { to, isPackage }: Import,
): string | null {
  const rule = only.find(({ what }) =>
    what.endsWith('/')
      ? !isPackage && to.startsWith(what)
      : to === what || to.startsWith(`${what}/`),
  );
  if (!rule) return null;
  const names = from?.owner === 'shared' ? [`shared/${from.room}`] : [from?.room ?? ''];
  return names.some((name) => rule.places.includes(name))
    ? null
    : `${rule.what} is only for ${rule.places.join(', ')}`;
}

/** Whether a room may see another one of the same owner. */
function roomSentence(heights: Map<string, number>, from: Place, to: Place): string | null {
  if (from.room === to.room || from.room === '') return null;
  for (const { owner, room } of [from, to])
    if (room !== '' && !heights.has(room)) return `${owner}/${room} stands in no line of LAYERS`;
  if (to.room === '')
    return `${from.owner}/${from.room} may not see what puts ${to.owner} together`;
  const isLower = (heights.get(to.room) ?? 0) < (heights.get(from.room) ?? 0);
  return isLower
    ? null
    : `${from.owner}/${from.room} may not see ${to.owner}/${to.room}: it is not in a lower layer`;
}

function sentenceOf(rules: Rules, found: Import): string | null {
  const from = placeOf(found.from);
  const to = placeOf(found.to);
  const reserved = reservedSentence(rules, from, found);
  if (reserved || found.isPackage || found.to.startsWith('wasm/')) return reserved;
  if (rules.top.includes(found.to)) return `nobody imports ${found.to}`;
  if (!from) return null;
  if (!to) return `${found.to} puts the page together: ${from.owner} may not see it`;
  if (from.owner === to.owner)
    return roomSentence(from.owner === 'shared' ? rules.shared : rules.rooms, from, to);
  return to.owner === 'shared' ? null : `${from.owner} may not see ${to.owner}`;
}

/** The files of each way of imports that ends where it began, once each. */
function circles(imports: Import[]): string[][] {
  const ways = new Map<string, string[]>();
  for (const { from, to, isPackage } of imports)
    if (!isPackage) ways.set(from, [...(ways.get(from) ?? []), to]);
  const done = new Set<string>();
  const found: string[][] = [];
  const walk = (file: string, path: string[]): void => {
    const start = path.indexOf(file);
    if (start >= 0) found.push(path.slice(start));
    if (start >= 0 || done.has(file)) return;
    for (const next of ways.get(file) ?? []) walk(next, [...path, file]);
    done.add(file);
  };
  for (const file of ways.keys()) walk(file, []);
  return found;
}

/** Every violation under `folder`, as a printable line. */
function checkTree(folder: string): string[] {
  const rules = readRules(readFileSync(join(folder, 'LAYERS'), 'utf8'));
  const src = join(folder, 'src');
  const files = readdirSync(src, { recursive: true, encoding: 'utf8' })
    .map((file) => file.replaceAll('\\', '/'))
    .filter((file) => /\.(ts|css)$/.test(file) && !file.startsWith('wasm/'))
    .sort();
  const imports = files.flatMap((file) => importsOf(src, file));
  const broken = imports.flatMap((found) => {
    const sentence = sentenceOf(rules, found);
    return sentence === null ? [] : `${found.from}:${found.line}: ${sentence}`;
  });
  const rounds = circles(imports).map(
    (round) =>
      `${round[0]}:1: imports itself by way of ${[...round.slice(1), round[0]].map((file) => basename(file ?? '')).join(', ')}`,
  );
  return [...broken, ...rounds];
}

/** Files of a scratch tree: their text, and the violation expected of each or null. */
const PLANTED: Record<string, [text: string, expected: string | null]> = {
  'main.ts': ["import './tabs';\nimport './veil/veil-view';\nimport './wrap/wrap-view';\n", null],
  'tabs.ts': ["import { element } from './shared/panels/element';\n", null],
  'shared/bindings/frame.ts': ['', null],
  'shared/panels/element.ts': [
    "import type { F } from '../bindings/frame';\n// '../../main'\n",
    null,
  ],
  'shared/state/up.ts': [
    "\nimport { e } from '../panels/element';\n",
    ':2: shared/state may not see shared/panels',
  ],
  'shared/stage/beside.ts': [
    "import { e } from '../panels/element';\n",
    ':1: shared/stage may not see shared/panels',
  ],
  'shared/stage/canvas.ts': ["import { Scene } from 'three';\n", null],
  'shared/attic/old.ts': [
    "import type { F } from '../bindings/frame';\n",
    'shared/attic stands in no line',
  ],
  'shared/state/of-view.ts': [
    "import type { S } from '../../veil/state/veil-state';\n",
    'shared may not see veil',
  ],
  'veil/veil-view.ts': ["import './veil.css';\nimport { p } from './panels/pane';\n", null],
  'veil/veil.css': ['', null],
  'veil/state/veil-state.ts': ["import type { F } from '../../shared/bindings/frame';\n", null],
  'veil/state/high.ts': [
    "import { r } from '../run/veil-run';\n",
    'veil/state may not see veil/run',
  ],
  'veil/run/veil-run.ts': [
    "new Worker(new URL('../worker/veil-worker.ts', import.meta.url));\n",
    null,
  ],
  'veil/worker/veil-worker.ts': ["import create from '../../wasm/veil.mjs';\n", null],
  'veil/panels/pane.ts': [
    "import create from '../../wasm/veil.mjs';\n",
    'wasm/ is only for worker',
  ],
  'veil/panels/drawn.ts': ["import { Scene } from 'three';\n", 'three is only for'],
  'veil/panels/wired.ts': [
    "import { v } from '../veil-view';\n",
    'may not see what puts veil together',
  ],
  'veil/panels/tabbed.ts': ["import { t } from '../../tabs';\n", 'tabs.ts puts the page together'],
  'veil/panels/chart/axis.ts': ["import type { F } from '../../../shared/bindings/frame';\n", null],
  'veil/panels/energy/line.ts': ["import { a } from '../chart/axis';\n", null],
  'veil/panels/contact/beside.ts': [
    "import { l } from '../energy/line';\n",
    'veil/panels/contact may not see veil/panels/energy',
  ],
  'veil/panels/levels/up.ts': [
    "import { p } from '../pane';\n",
    'veil/panels/levels may not see veil/panels',
  ],
  'veil/panels/attic/old.ts': [
    "import { p } from '../pane';\n",
    'veil/panels/attic stands in no line',
  ],
  'wrap/wrap-view.ts': ["import '../veil/veil.css';\n", 'wrap may not see veil'],
  'wrap/state/root.ts': ["const m = await import('../../main');\n", 'nobody imports main.ts'],
  'wrap/state/hen.ts': ["import type { Egg } from './egg';\n", null],
  'wrap/state/egg.ts': [
    "import type { Hen } from './hen';\n",
    'imports itself by way of hen.ts, egg.ts',
  ],
};

function selfTest(): string[] {
  const folder = mkdtempSync(join(tmpdir(), 'pleat-layers-'));
  try {
    for (const [file, [text]] of Object.entries(PLANTED)) {
      mkdirSync(join(folder, 'src', dirname(file)), { recursive: true });
      writeFileSync(join(folder, 'src', file), text);
    }
    writeFileSync(join(folder, 'LAYERS'), readFileSync(join(root, 'LAYERS')));
    const found = checkTree(folder);
    return Object.entries(PLANTED).flatMap(([file, [, expected]]) => {
      const lines = found.filter((line) => line.startsWith(`${file}:`));
      if (expected === null) return lines.map((line) => `self-test: false alarm: ${line}`);
      const isFound = lines.length === 1 && lines[0]?.includes(expected);
      return isFound
        ? []
        : `self-test: ${file}: expected one "${expected}", found ${JSON.stringify(lines)}`;
    });
  } finally {
    rmSync(folder, { recursive: true });
  }
}

const violations = process.argv.includes('--self-test') ? selfTest() : checkTree(root);
for (const violation of violations) console.log(violation);
process.exitCode = violations.length > 0 ? 1 : 0;
