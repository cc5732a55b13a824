// Lets garments settle on the standing figure, by the native command: see assets/starts/README.md. Run by
// `npm run starts`.
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

/** How long, and in how thick an air, which takes the motion of the fall [s], [kg/m^3]. */
const SETTLING = { durationS: 12, airKgPerM3: 20 };

/** The figure begins to walk when all is over [s]. */
const STANDING_S = 1000;

/** Places are rounded to micrometres: strains of 1e-4 on edges of 1 cm. */
const DIGITS = 6;

const FINE_LEVEL = 2;

const root = fileURLToPath(new URL('../..', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'pleat-starts-'));
const readJson = (path: string) => JSON.parse(readFileSync(join(root, path), 'utf8'));

/** Places of the cloth of a scene when all has come to rest, on this mesh. */
function settled(name: string, refinement?: object): number[][] {
  const { start: _, ...scene } = readJson(`assets/scenes/garments/${name}.json`);
  const motion = readJson(join('assets/scenes/garments', scene.figure.motion));
  const air = { ...scene.world.air, density_kg_per_m3: SETTLING.airKgPerM3 };
  const settling = {
    ...scene,
    figure: { ...scene.figure, motion, blend_time_s: STANDING_S },
    refinement: refinement ?? scene.refinement,
    world: { ...scene.world, air },
    duration_s: SETTLING.durationS,
  };
  const [file, state] = [join(folder, 'scene.json'), join(folder, `${name}.json`)];
  writeFileSync(file, JSON.stringify(settling));
  const words = ['run', file, '--state', state];
  execFileSync(join(root, 'build/release/cli/pleat'), words, {
    stdio: ['ignore', 'ignore', 'inherit'],
  });
  return JSON.parse(readFileSync(state, 'utf8')).positions_m;
}

function writeStart(name: string, found: readonly number[][]): void {
  const places = found.map((place) => place.map((x) => Number(x.toFixed(DIGITS))));
  const lines = places.map((place) => JSON.stringify(place)).join(',\n');
  const path = `assets/starts/${name}.json`;
  writeFileSync(join(root, path), `{"positions_m":[\n${lines}\n]}\n`);
  console.log(`${path}: ${places.length} vertices`);
}

const garments = ['skirt', 'trousers', 'slim_trousers'];
const all = garments.flatMap((garment) => [garment, `${garment}_even`]);
const wanted = process.argv.slice(2);
mkdirSync(join(root, 'assets/starts'), { recursive: true });
for (const name of wanted.length > 0 ? wanted : all)
  writeStart(
    name,
    name.endsWith('_even')
      ? settled(`${name}_fast_walk`)
      : settled(`${name}_walk`, { level: FINE_LEVEL }),
  );
rmSync(folder, { recursive: true });
