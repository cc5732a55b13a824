// Advice of warnings, followed to the letter: what a run says to try first ends what it warns of.
import { join } from 'node:path';

import { changed, readJson, root, shippedScene } from './assets.mjs';
import { tell } from './bench-options.mjs';
import { atLeast, short, table } from './bench-rows.mjs';
import { ran } from './command.mjs';
import { lyingSheet } from './same-cloth-scenes.mjs';

const kExplosions = join(root, 'native-tests', 'support', 'explosions.json');

/** Explosions of a method's making: no method helps in a million times gravity, or from inside a ball. */
const explosions = () =>
  readJson(kExplosions)
    .filter((one) => !one.changes['/world/gravity_m_per_s2'] && !one.changes['/world/colliders'])
    .map(({ scene, changes, seconds }) => ({
      name: `${scene} ${JSON.stringify(changes)}`,
      scene: changed(shippedScene(scene), { ...changes, '/duration_s': seconds }),
    }));

/** Square of n x n cells that swings down from its upper edge. */
function swinging(fabric, n, cell, method, changes = {}) {
  const scene = {
    name: 'swinging',
    cloth: lyingSheet(n, n * cell, [0, 1, 0]),
    fabric: { name: fabric },
    pins: [{ part: 'upper_edge' }],
    duration_s: 0.5,
    method,
  };
  const name = `${fabric}, ${n} x ${n} cells of ${1e3 * cell} mm, ${JSON.stringify(method)}`;
  return { name, scene: changed(scene, changes) };
}

const swatches = () => [
  swinging('silk', 12, 0.025, { stepper: 'implicit' }),
  swinging('wool', 12, 0.01, { stepper: 'implicit' }),
  swinging('denim', 12, 0.05, { stepper: 'implicit' }),
  swinging('leather', 12, 0.025, { stepper: 'pbd' }),
  swinging('canvas', 12, 0.05, { stepper: 'hpbd' }),
  swinging('fine cotton', 12, 0.02, { stepper: 'projective', iterations: 2 }),
  swinging('polyester', 12, 0.025, { stepper: 'xpbd', substeps: 2 }),
  swinging('velvet', 12, 0.025, { stepper: 'multigrid', substeps: 1 }),
  swinging('chiffon', 12, 0.02, { stepper: 'xpbd', substeps: 3 }),
  swinging('leather', 18, 0.015, { stepper: 'multigrid', substeps: 4 }),
  swinging('spandex', 18, 0.015, { stepper: 'xpbd', substeps: 6 }),
];

const kRestSeconds = 8;

/** A strip of two bending lengths with two rows held, and a sheet that starts as it hangs. */
function resting(stepper, isStrip) {
  const changes = isStrip
    ? {
        '/cloth/sheet/width_m': 0.03,
        '/cloth/sheet/columns': 6,
        '/pins': [{ box: { low_m: [-1, 0.9, -1], high_m: [1, 1.1, 0.006] } }],
        '/duration_s': kRestSeconds,
      }
    : { '/cloth/sheet/warp_direction': [0, -1, 0], '/duration_s': kRestSeconds };
  const cell = isStrip ? 0.005 : 0.025;
  const { name, scene } = swinging('linen', 20, cell, { stepper }, changes);
  return { name: `${isStrip ? 'strip' : 'hung'}, ${name}`, scene };
}

const listed = () => [
  ...explosions(),
  ...swatches(),
  ...['projective', 'pbd', 'hpbd', 'multigrid', 'xpbd'].map((stepper) => resting(stepper, true)),
  ...['pbd', 'hpbd'].map((stepper) => resting(stepper, false)),
];

/** Status and warnings of a run, but for what was solved all the same. */
function ended(scene) {
  const words = ['run', { ...scene, record: { format: 'none' } }, '--json'];
  const { status, warnings } = JSON.parse(ran(words, 'ignore').stdout);
  return { status, warnings: warnings.filter(({ kind }) => kind !== 'given_up') };
}

function rowOf({ name, scene }) {
  tell(name);
  const { status, warnings } = ended(scene);
  const [told] = warnings;
  if (!told) return { case: name, status, told: null, advice: null, helps: false, left: [] };
  const [[pointer, value]] = Object.entries(told.hints);
  const again = ended(changed(scene, { [pointer]: value }));
  const left = again.warnings.map(({ kind }) => kind);
  return {
    case: name,
    status: again.status,
    told: `${told.kind} ${short(told.value)}`,
    advice: `${pointer} ${JSON.stringify(value)}`,
    helps: !left.includes(told.kind),
    left,
  };
}

export function advice() {
  const rows = listed().map(rowOf);
  const columns = {
    case: 'case',
    told: 'told',
    'advice, followed': 'advice',
    'told then': ({ left }) => left.join(', ') || '-',
  };
  const share = rows.filter(({ helps }) => helps).length / rows.length;
  return {
    rows,
    goals: [atLeast('advice_that_helps_share', share, 0.95, rows)],
    text: `${rows.length} runs that warn, and again with what they advise first\n\n${table(rows, columns)}`,
  };
}
