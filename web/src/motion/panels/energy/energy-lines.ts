// The lines of the account of energy: what the cloth has, what was taken from it, and that both add up.
import type { EnergyNumbers } from '../../../shared/bindings/pleat-module';

export interface EnergyLine {
  kind: Exclude<keyof EnergyNumbers, 'time_s' | 'start'> | 'sum';
  title: string;
  joules(numbers: EnergyNumbers): number;
}

/** Energies of the cloth now. */
const HELD: readonly EnergyLine[] = [
  { kind: 'kinetic', title: 'Motion', joules: ({ kinetic }) => kinetic },
  { kind: 'elastic', title: 'Stretch and bending', joules: ({ elastic }) => elastic },
  { kind: 'gravity', title: 'Height, against the start', joules: ({ gravity }) => gravity },
];

/** Energies that went elsewhere since the start; negative where the cloth has gained. */
const LOST: readonly EnergyLine[] = [
  { kind: 'damping', title: 'Lost to damping', joules: ({ damping }) => -damping },
  { kind: 'air', title: 'Lost to air', joules: ({ air }) => -air },
  { kind: 'contact', title: 'Lost to contact', joules: ({ contact }) => -contact },
  { kind: 'pins', title: 'Lost to pins and hand', joules: ({ pins }) => -pins },
  { kind: 'tears', title: 'Lost to tears', joules: ({ tears }) => -tears },
  { kind: 'drift', title: 'Lost by the method', joules: ({ drift }) => -drift },
];

const SUM: EnergyLine = {
  kind: 'sum',
  title: 'All together',
  joules: (numbers) => [...HELD, ...LOST].reduce((sum, line) => sum + line.joules(numbers), 0),
};

/** Part of the largest energy below which a line cannot be told from none. */
const LEAST_PART = 1e-12;

/** The lines that differ from none somewhere; the sum always. */
export function linesOf(samples: readonly EnergyNumbers[]): EnergyLine[] {
  const largest = (line: EnergyLine) =>
    Math.max(0, ...samples.map((sample) => Math.abs(line.joules(sample))));
  const lines = [...HELD, ...LOST];
  const most = Math.max(...lines.map(largest));
  return [...lines.filter((line) => largest(line) > LEAST_PART * most), SUM];
}
