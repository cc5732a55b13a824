// npm run display-rates: hashes of the flag's positions after each second, as displays of several rates
// show it; one line of JSON for each.
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { firstCore } from '../../build-steps/built-core.ts';
import { openPageCode } from './page-code.mjs';

const kSeconds = 4;
const flag = readFileSync(new URL('../../../assets/scenes/flag.json', import.meta.url), 'utf8');
const { step_s } = JSON.parse(flag).method;

const code = await openPageCode();
const { createClock } = await code.load('/src/shared/state/clock.ts');
const { fabricsText } = await code.load('/src/shared/fabric/fabric-data.ts');

async function shownSeconds(rate) {
  const { Simulation } = await firstCore();
  const simulation = new Simulation(fabricsText);
  const { ok, what } = JSON.parse(simulation.load(flag));
  if (!ok) throw new Error(what);
  let nPictures = 0;
  const clock = createClock({ later: () => {}, nowMs: () => (1000 * nPictures) / rate });
  const hashes = [];
  let steps = 0;
  while (hashes.length < kSeconds) {
    nPictures += 1;
    clock.tick(1);
    for (let due = clock.take(step_s, Number.POSITIVE_INFINITY); due > 0; --due) {
      simulation.step(1);
      if (++steps % Math.round(1 / step_s) === 0)
        hashes.push(createHash('sha256').update(simulation.exactPositions()).digest('hex'));
    }
  }
  simulation.delete();
  return hashes.join();
}

for (const rate_hz of [30, 60, 120, 144])
  console.log(JSON.stringify({ rate_hz, status: 'ok', sha256: await shownSeconds(rate_hz) }));
await code.close();
process.exit();
