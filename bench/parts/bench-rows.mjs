// Rows with speed and error, as the command makes them of runs; the table they are printed in, and
// goal lines.
import { askRows } from './command.mjs';

export function median(values) {
  const sorted = [...values].sort((a, b) => a - b);
  const middle = sorted.length >> 1;
  return sorted.length % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

/** True for a run that came to its end: only then its numbers are of what was asked for. */
export function hasFinished({ status }) {
  return status === 'ok' || status === 'not_converged';
}

/**
 * Runs the contestants side by side, `repeat` rounds, `turnFrames` frames of each in turn, so that
 * a change of the machine's speed meets all of them alike; the command makes a row of each.
 * Positions are taken in the first round.
 *
 * contestants: [{label, scene, method, n_vertices, begin: async (times) => {advance, finish}}]
 * masses: weights of the vertices, where they are not those of each run
 */
export async function measure(contestants, settings) {
  const {
    repeat,
    times,
    against,
    masses,
    commit,
    tell,
    frames = 60,
    turnFrames = frames,
  } = settings;
  const runs = contestants.map(() => []);
  for (let round = 0; round < repeat; ++round) {
    const begun = [];
    for (const { label, begin } of contestants) {
      tell(`round ${round + 1} of ${repeat}: ${label}`);
      begun.push(await begin(round === 0 ? times : []));
    }
    for (let done = 1; done < frames; done += turnFrames)
      for (const run of begun) await run.advance(turnFrames);
    for (const [i, run] of begun.entries()) runs[i].push(await run.finish());
  }
  return rowsOf(contestants, runs, { times, against, masses, commit, turnFrames });
}

/** Rows of runs that have been made, `runs` of each contestant. */
export function rowsOf(contestants, runs, { times, against, masses, commit, turnFrames = 1 }) {
  const { reference, rest_diagonal_m, samples } = against;
  return askRows('bench', 'rows', {
    reference,
    rest_diagonal_m,
    samples,
    times_s: times,
    turn_frames: turnFrames,
    commit,
    masses_kg: masses,
    contestants: contestants.map(({ begin, ...about }, i) => ({ ...about, runs: runs[i] })),
  });
}

/** Three significant digits, or a dash for what could not be measured. */
export function short(value) {
  if (!Number.isFinite(value)) return '-';
  return Number(value.toPrecision(3)).toString();
}

/** Lines of cells under a head, as Markdown. */
export function markdown(head, lines) {
  const widths = head.map((title, c) =>
    Math.max(title.length, ...lines.map((line) => String(line[c]).length)),
  );
  const print = (cells) =>
    `| ${cells.map((cell, c) => String(cell).padEnd(widths[c])).join(' | ')} |`;
  const rule = widths.map((width) => '-'.repeat(width));
  return [head, rule, ...lines].map(print).join('\n');
}

export function table(rows) {
  const head = [
    'contestant',
    'target',
    'vertices',
    'ms/frame',
    'spread',
    'rms stretch %',
    'largest %',
    'errors mm',
    '% (last)',
    'memory MB',
    'status',
  ];
  const lines = rows.map((row) => [
    row.label,
    row.target,
    row.n_vertices,
    short(row.ms_per_frame),
    short(row.spread_ms),
    short(100 * row.rms_stretch),
    short(100 * row.largest_stretch),
    Object.values(row.position_errors_m)
      .map((error) => short(1e3 * error))
      .join(' / '),
    short(row.position_error_percent),
    short(row.process_peak_memory_bytes && row.process_peak_memory_bytes / 1e6),
    row.status,
  ]);
  return markdown(head, lines);
}

/**
 * A promised figure: `goal NAME VALUE at-most|at-least BOUND ok|short`. It is short unless both are
 * numbers and every row of `rows`, from which they come, is of a run that came to its end.
 */
export function goal(name, value, direction, bound, rows = []) {
  const isMeasured = rows.every(hasFinished) && Number.isFinite(value) && Number.isFinite(bound);
  const ok = isMeasured && (direction === 'at-most' ? value <= bound : value >= bound);
  return {
    name,
    ok,
    line: `goal ${name} ${short(value)} ${direction} ${short(bound)} ${ok ? 'ok' : 'short'}`,
  };
}

/** The slope of a straight line through (log x, log y). */
export function exponent(points) {
  const logs = points.map((point) => point.map(Math.log));
  const n = logs.length;
  const [mx, my] = [0, 1].map((k) => logs.reduce((sum, point) => sum + point[k], 0) / n);
  const above = logs.reduce((sum, [x, y]) => sum + (x - mx) * (y - my), 0);
  return above / logs.reduce((sum, [x]) => sum + (x - mx) ** 2, 0);
}
