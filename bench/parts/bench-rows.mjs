// Rows with speed and error, as the command makes them of runs; the tables they are printed in, and
// goal lines.
import { tell } from './bench-options.mjs';
import { askRows, commit } from './command.mjs';

export function median(values) {
  const sorted = [...values].sort((a, b) => a - b);
  const middle = sorted.length >> 1;
  return sorted.length % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

export const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;
export const spread = (values) => Math.max(...values) - Math.min(...values);

/** The largest; NaN where a value is none. */
export const largest = (values) => Math.max(...values.map((value) => value ?? Number.NaN));

/** The slope of a straight line through (log x, log y). */
export function exponent(points) {
  const logs = points.map((point) => point.map(Math.log));
  const [mx, my] = [0, 1].map((k) => mean(logs.map((point) => point[k])));
  const above = logs.reduce((sum, [x, y]) => sum + (x - mx) * (y - my), 0);
  return above / logs.reduce((sum, [x]) => sum + (x - mx) ** 2, 0);
}

/** Places in ascending order from 1; equal values share the mean of theirs. */
function ranks(values) {
  return values.map((value) => {
    const smaller = values.filter((other) => other < value).length;
    const equal = values.filter((other) => other === value).length;
    return smaller + (equal + 1) / 2;
  });
}

/** Spearman's rank correlation, in [-1, 1]; NaN where there is nothing to rank. */
export function rankCorrelation(a, b) {
  const [x, y] = [ranks(a), ranks(b)];
  const middle = (a.length + 1) / 2;
  const product = (p, q) =>
    p.reduce((sum, value, k) => sum + (value - middle) * (q[k] - middle), 0);
  return product(x, y) / Math.sqrt(product(x, x) * product(y, y));
}

/** True for a run that came to its end: only then its numbers are of what was asked for. */
export function hasFinished({ status }) {
  return status === 'ok' || status === 'not_converged';
}

/** Runs of each of [{label, run}], which take turns, `repeat` rounds. */
export async function inTurn(repeat, contestants) {
  const runs = contestants.map(() => []);
  for (let round = 1; round <= repeat; ++round)
    for (const [i, { label, run }] of contestants.entries()) {
      tell(`round ${round} of ${repeat}: ${label}`);
      runs[i].push(await run());
    }
  return runs;
}

/** One row of several runs: numbers at `keys` are medians, the rest is the first's. */
export function medianRow(runs, keys) {
  const middles = keys.map((key) => [key, median(runs.map((run) => run[key]))]);
  return { ...runs[0], ...Object.fromEntries(middles) };
}

/**
 * Runs of each contestant side by side, `repeat` rounds, `turnFrames` frames of each in turn, so
 * that a change of the machine's speed meets all of them alike. Positions are taken in the first
 * round.
 *
 * contestants: [{label, begin: async (times) => {advance, finish}}]
 */
export async function sideBySide(contestants, settings) {
  const { repeat, times = [], frames = 60, turnFrames = frames } = settings;
  const runs = contestants.map(() => []);
  for (let round = 1; round <= repeat; ++round) {
    const begun = [];
    for (const { label, begin } of contestants) {
      tell(`round ${round} of ${repeat}: ${label}`);
      begun.push(await begin(round === 1 ? times : []));
    }
    for (let done = 1; done < frames; done += turnFrames)
      for (const run of begun) await run.advance(turnFrames);
    for (const [i, run] of begun.entries()) runs[i].push(await run.finish());
  }
  return runs;
}

/**
 * Rows of contestants side by side, which have a scene and a method, as the command makes them.
 *
 * masses: weights of the vertices, where they are not those of each run
 */
export async function measure(contestants, settings) {
  const { frames = 60, turnFrames = frames } = settings;
  const runs = await sideBySide(contestants, settings);
  return rowsOf(contestants, runs, { ...settings, turnFrames });
}

/** Rows of runs that have been made, `runs` of each contestant. */
export function rowsOf(contestants, runs, { times, against, masses, turnFrames = 1 }) {
  return askRows('bench', 'rows', {
    ...against,
    times_s: times,
    turn_frames: turnFrames,
    commit,
    masses_kg: masses,
    contestants: contestants.map(({ begin, ...about }, i) => ({
      ...about,
      n_vertices: runs[i][0].n_vertices,
      runs: runs[i],
    })),
  });
}

/** Three significant digits, or a dash for what could not be measured. */
export function short(value) {
  if (!Number.isFinite(value)) return '-';
  return Number(value.toPrecision(3)).toString();
}

/** Lines of cells under a head, as Markdown: texts and whole numbers as they are, others `short`. */
export function markdown(head, lines) {
  const asText = (cell) =>
    typeof cell === 'string' || Number.isInteger(cell) ? String(cell) : short(cell);
  const texts = lines.map((line) => line.map(asText));
  const widths = head.map((title, c) =>
    Math.max(title.length, ...texts.map((line) => line[c].length)),
  );
  const print = (cells) => `| ${cells.map((cell, c) => cell.padEnd(widths[c])).join(' | ')} |`;
  const rule = widths.map((width) => '-'.repeat(width));
  return [head, rule, ...texts].map(print).join('\n');
}

/** Rows as Markdown. columns: {title: a row's key, or row => cell} */
export function table(rows, columns) {
  const cell = (of, row) => (typeof of === 'function' ? of(row) : row[of]);
  const lines = rows.map((row) => Object.values(columns).map((of) => cell(of, row)));
  return markdown(Object.keys(columns), lines);
}

/** References that errors of rows are measured against, and the rows' table. */
export function described(rows) {
  const references = [...new Set(rows.map((row) => row.reference.description))];
  const columns = {
    contestant: 'label',
    target: 'target',
    vertices: 'n_vertices',
    'ms/frame': 'ms_per_frame',
    spread: 'spread_ms',
    'rms stretch %': (row) => 100 * row.rms_stretch,
    'largest %': (row) => 100 * row.largest_stretch,
    'errors mm': (row) => millimetres(Object.values(row.position_errors_m)),
    '% (last)': 'position_error_percent',
    'memory MB': (row) => row.process_peak_memory_bytes / 1e6,
    status: 'status',
  };
  return `errors against ${references.join('; ')}\n\n${table(rows, columns)}`;
}

export const millimetres = (lengths) => lengths.map((length) => short(1e3 * length)).join(' / ');

/**
 * A promised number: `goal NAME VALUE at-most|at-least BOUND ok|short`. It is short unless both are
 * numbers and every row of `rows`, from which they come, is of a run that came to its end.
 */
export function goal(name, value, direction, bound, rows = []) {
  const isMeasured = rows.every(hasFinished) && Number.isFinite(value) && Number.isFinite(bound);
  const ok = isMeasured && (direction === 'at-most' ? value <= bound : value >= bound);
  const line = `goal ${name} ${short(value)} ${direction} ${short(bound)} ${ok ? 'ok' : 'short'}`;
  return { name, ok, line };
}

export const atMost = (name, value, bound, rows) => goal(name, value, 'at-most', bound, rows);
export const atLeast = (name, value, bound, rows) => goal(name, value, 'at-least', bound, rows);
