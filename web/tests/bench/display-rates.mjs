// npm run display-rates: hashes of the flag's positions after each second, as displays of several rates
// show it; one line of JSON for each.
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';

import { fabricsText } from '../../../bench/parts/assets.mjs';
import { answer, wasmModule } from '../../../bench/parts/contestants.mjs';
import { createPacer } from '../../src/shared/state/pacer.ts';

const kSeconds = 4;
const flag = readFileSync(new URL('../../../assets/scenes/flag.json', import.meta.url), 'utf8');
const { step_s } = JSON.parse(flag).method;

async function shownSeconds(rate) {
  const module = await wasmModule();
  const simulation = new module.Simulation(fabricsText());
  answer(simulation.load(flag));
  const pacer = createPacer();
  const hashes = [];
  let steps = 0;
  while (hashes.length < kSeconds) {
    pacer.advance(1 / rate);
    for (let due = pacer.take(step_s, 0.1); due > 0; --due) {
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
