// Cases whose right outcome is known, with every stepper: each row is right within its tolerance,
// or the run warns of it, or it is wrong without a word.
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';

import { BadInput, tell } from './bench-options.mjs';
import { markdown, short } from './bench-rows.mjs';
import { inFolder, printed, ran } from './command.mjs';

/** Names of all steppers, as the command tells them. */
export const steppers = () =>
  [...printed('help', 'steppers').matchAll(/^ {2}(\w+)/gm)].map(([, name]) => name);

export const explicitOnes = ['explicit', 'rk4'];

/**
 * A scene's end: its metrics, places and velocities as triples (none after a run that the numbers
 * ended), root of the mean square of the speed by the kinetic energy; or the sentence by which the
 * scene is refused.
 */
function endOf(scene) {
  return inFolder((folder) => {
    const state = join(folder, 'state.json');
    const begin = performance.now();
    try {
      const { stdout } = ran(['run', scene, '--json', '--drift', '--state', state], 'pipe');
      const metrics = JSON.parse(stdout);
      const seconds = (performance.now() - begin) / 1e3;
      if (!existsSync(state))
        return { metrics, seconds, positions: [], velocities: [], speed: Number.NaN };
      const { positions_m, velocities_m_per_s } = JSON.parse(readFileSync(state, 'utf8'));
      const still = positions_m.map(() => [0, 0, 0]);
      return {
        metrics,
        seconds,
        positions: positions_m,
        velocities: velocities_m_per_s ?? still,
        speed: Math.sqrt((2 * metrics.energy.kinetic_j) / metrics.mass_kg),
      };
    } catch (error) {
      if (error instanceof BadInput) return { refused: error.message };
      throw error;
    }
  });
}

const kSaysNothingOfTheResult = ['given_up']; // solved all the same

/** Kinds of warnings by which a run says that its result is off, and its status unless "ok". */
export function toldOf({ status, warnings }) {
  const kinds = warnings.map(({ kind }) => kind);
  const told = kinds.filter((kind) => !kSaysNothingOfTheResult.includes(kind));
  return status === 'ok' || told.includes(status) ? told : [...told, status];
}

/** "ok", "warned" or "WRONG"; a value that is none is not right. */
export function verdictOf(value, { right, tolerance }, told) {
  if (Math.abs(value - right) <= tolerance) return 'ok';
  return told.length > 0 ? 'warned' : 'WRONG';
}

/** A refusal without the file's path and the stepper's name. */
const shortened = (sentence, stepper) =>
  sentence.replace(/^.*\.json: /, '').replaceAll(` for ${stepper}`, '');

const without = (row, verdict, reason) => ({ ...row, verdict, reason, value: null, told: [] });

/**
 * Rows of one case with one stepper, a row for each of its `measures`.
 *
 * one: {name, scene, of: (stepper) => scene with that stepper, or a text: why it is left out,
 *       measures: [{of, unit, right, tolerance, value: (end) => number}]}
 */
function rowsOf(one, stepper) {
  const named = one.measures.map(({ value, ...about }) => ({
    case: one.name,
    stepper,
    ...about,
    reference: { id: `${one.name}, ${about.of}`, description: one.source },
  }));
  const scene = one.of(stepper);
  if (typeof scene === 'string') return named.map((row) => without(row, 'left out', scene));
  tell(`${one.name}, ${stepper}`);
  const end = endOf({ ...scene, record: { format: 'none' } });
  if (end.refused)
    return named.map((row) => without(row, 'refused', shortened(end.refused, stepper)));
  const told = toldOf(end.metrics);
  return named.map((row, i) => {
    const value = end.positions.length ? one.measures[i].value(end) : Number.NaN;
    return {
      ...row,
      value,
      verdict: verdictOf(value, row, told),
      told,
      status: end.metrics.status,
      method: end.metrics.method,
      unbalanced_share: end.metrics.unbalanced_share_at_rest,
      n_vertices: end.metrics.n_vertices,
      seconds: end.seconds / named.length,
      core: end.metrics.core,
    };
  });
}

export function runCases(cases, names) {
  return cases.flatMap((one) => names.flatMap((stepper) => rowsOf(one, stepper)));
}

const kWorst = ['left out', 'refused', 'ok', 'warned', 'WRONG'];

/** The worst of several rows, which stands for them: by verdict, then by distance. */
export function worstOf(rows) {
  const badness = (row) => [kWorst.indexOf(row.verdict), Math.abs(row.value - row.right)];
  return rows.reduce((worst, row) => {
    const [a, b] = [badness(worst), badness(row)];
    return b[0] > a[0] || (b[0] === a[0] && !(b[1] <= a[1])) ? row : worst;
  });
}

function cellOf(row) {
  if (row.verdict === 'left out' || row.verdict === 'refused') return row.verdict;
  if (row.verdict === 'ok') return row.told.length ? `ok ${short(row.value)} (told)` : 'ok';
  return `${row.verdict} ${short(row.value)}`;
}

/** Rows as a table: a line for each thing that is measured, a column for each stepper. */
export function verdictTable(rows, names) {
  const key = (row) => `${row.case}: ${row.of}`;
  const keys = [...new Set(rows.map(key))];
  const lines = keys.map((wanted) => {
    const of = rows.filter((row) => key(row) === wanted);
    const cells = names.map((stepper) => {
      const row = of.find((found) => found.stepper === stepper);
      return row ? cellOf(row) : '-';
    });
    const [{ right, tolerance, unit }] = of;
    return [wanted, `${short(right)} ± ${short(tolerance)} ${unit}`.trim(), ...cells];
  });
  return markdown(['case', 'right', ...names], lines);
}

/** How many rows of a stepper are right, warned, wrong without a word, refused or left out. */
export function counts(rows, stepper) {
  const its = rows.filter((row) => row.stepper === stepper);
  const having = (verdict) => its.filter((row) => row.verdict === verdict).length;
  const [ok, warned, wrong] = ['ok', 'warned', 'WRONG'].map(having);
  return {
    stepper,
    ok,
    warned,
    wrong,
    absent: having('refused') + having('left out'),
    share: ok / (ok + warned + wrong),
    seconds: its.reduce((sum, row) => sum + (row.seconds ?? 0), 0),
  };
}

/** Why steppers were left out or refused, and of how many rows: a line for each reason. */
export function reasons(rows) {
  const absent = rows.filter(({ verdict }) => verdict === 'left out' || verdict === 'refused');
  const why = ({ verdict, reason }) => `${verdict}, ${reason}`;
  return [...new Set(absent.map(why))]
    .map((text) => {
      const its = absent.filter((row) => why(row) === text);
      const names = [...new Set(its.map(({ stepper }) => stepper))];
      const having = (name) => its.filter(({ stepper }) => stepper === name).length;
      return `${text}: ${names.map((name) => `${name} ${having(name)}`).join(', ')}`;
    })
    .join('\n');
}
