// Words on what a run shows that its scene cannot explain.
import type { RunWarning } from '../bindings/run-warning';
import { digits, percent } from './quantity';

/** Least stretch that is many lengths, however many. */
const MANY = 10;

function stretchText(strain: number | null): string {
  return strain === null || strain > MANY ? 'many times its length' : `by up to ${percent(strain)}`;
}

export function warningSentence({ kind, time_s, value, bound }: RunWarning): string {
  const since = `From ${digits(time_s, 2)} s on`;
  switch (kind) {
    case 'stretch':
      return `The run has exploded. ${since} the cloth is stretched ${stretchText(value)}; its weight explains ${percent(bound)}.`;
    case 'speed':
      return `The run has exploded. ${since} the cloth is as fast as ${digits(value, 2)} m/s; falling and pulling explain ${digits(bound, 2)} m/s.`;
    case 'unsolved':
      return `This is not how cloth moves. ${since} steps leave ${percent(value)} of their equations unsolved.`;
    case 'not_converged':
      return `${since} steps did not converge, and left ${percent(value)} of their equations unsolved.`;
    case 'given_up':
      return `${since} a factor solved steps that the solver gave up.`;
    case 'soft':
      return `${since} the cloth stretches like a softer fabric, ${stretchText(value)}; its own explains ${percent(bound)}.`;
    case 'unbalanced':
      return `${since} too few rounds hold the cloth up, not its threads: ${percent(value)} of its weight is unbalanced.`;
  }
}
