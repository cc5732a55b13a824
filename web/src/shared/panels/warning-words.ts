// Words on what a run shows that its scene cannot explain.
import type { RunWarning } from '../bindings/run-warning';
import { digits, percent } from './quantity';

/** Least stretch that is many lengths, however many. */
const MANY = 10;

/** Least stretch that is an explosion; less is too much all the same. */
const EXPLOSION = 1;

function stretchText(strain: number | null): string {
  return strain === null || strain > MANY ? 'many times its length' : `by up to ${percent(strain)}`;
}

/** Words on a count of substeps. */
const substepsText = (n: number | null) => (n === 1 ? 'one substep' : `${n ?? 'many'} substeps`);

export function warningSentence({ kind, time_s, value, bound }: RunWarning): string {
  const since = `from ${digits(time_s, 2)} s on`;
  switch (kind) {
    case 'stretch':
      return value !== null && value < EXPLOSION
        ? `The cloth stretches too much: ${since} ${stretchText(value)}, where woven cloth tears at about 10 %.`
        : `The run has exploded: ${since} the cloth is stretched ${stretchText(value)}.`;
    case 'speed':
      return `The run has exploded: ${since} the cloth moves at ${digits(value, 2)} m/s, which is too fast to be true.`;
    case 'unsolved':
      return `The computer stops before it has the answer: ${since} ${percent(value)} of each step is left unsolved, and the cloth sags like rubber.`;
    case 'not_converged':
      return `Steps did not converge: ${since} they left ${percent(value)} of their equations unsolved.`;
    case 'given_up':
      return `A factor solved steps that the solver gave up, ${since}.`;
    case 'soft':
      return `The cloth stretches like a softer fabric: ${since} ${stretchText(value)}, where its own would by ${percent(bound)}.`;
    case 'unbalanced':
      return `Steps that leave too much unsolved hold the cloth up, not its threads: ${since} ${percent(value)} of its weight is unbalanced.`;
    case 'held_back':
      return `The contact guard holds back ${percent(value)} of the vertices, ${since}: their motion is not the method’s.`;
    case 'blocked':
      return `Pins or solids would pull cloth through itself, and stay behind: ${since} in ${substepsText(value)}.`;
  }
}
