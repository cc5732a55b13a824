// The account of energy in a few sentences.

import type { EnergyNumbers } from '../../../shared/bindings/pleat-module';
import { energyText, percent } from '../../../shared/panels/quantity';

const TAKERS = [
  ['damping', 'damping'],
  ['air', 'air'],
  ['contact', 'contact'],
  ['pins', 'pins and hand'],
  ['tears', 'tears'],
] as const;

/** "damping took 3.1 mJ, pins and hand gave 0.2 J". */
function worksText(now: EnergyNumbers): string {
  const works = TAKERS.filter(([kind]) => now[kind] !== 0).map(
    ([kind, name]) =>
      `${name} ${now[kind] < 0 ? 'took' : 'gave'} ${energyText(Math.abs(now[kind]))}`,
  );
  return works.length > 0 ? works.join(', ') : 'no force took any';
}

/** Words on what the method itself gained or lost, beside the most energy of motion so far. */
function driftText(samples: readonly EnergyNumbers[], { drift }: EnergyNumbers): string {
  const most = Math.max(...samples.map(({ kinetic }) => kinetic));
  const share = most > 0 ? `, ${percent(Math.abs(drift) / most)} of the most energy of motion` : '';
  const verb = drift > 0 ? 'added' : 'lost';
  return `The method itself ${verb} ${energyText(Math.abs(drift))}${share}: what no force explains from one step’s end to the next.`;
}

export function energyWords(samples: readonly EnergyNumbers[]): string {
  const [first] = samples;
  const now = samples.at(-1);
  if (!first || !now || samples.length < 2) return 'The lines begin with the next step.';
  const height = `${energyText(Math.abs(now.gravity))} ${now.gravity > 0 ? 'more' : 'less'}`;
  const held = `At ${now.time_s.toFixed(2)} s the cloth moves with ${energyText(now.kinetic)}, is stretched and bent by ${energyText(now.elastic)}, and has ${height} by height than at ${first.time_s.toFixed(2)} s.`;
  return `${held} Meanwhile ${worksText(now)}. ${driftText(samples, now)}`;
}
