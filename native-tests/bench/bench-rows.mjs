// Rows with speed and error, the table they are printed in, and goal lines.

export function median(values) {
  const sorted = [...values].sort((a, b) => a - b);
  const middle = sorted.length >> 1;
  return sorted.length % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

export const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;

/**
 * RMS distance of the same vertices, weighted by their masses, which are areas times a constant
 * [m].
 */
export function positionError(positions, right, masses) {
  let sum = 0;
  let weight = 0;
  masses.forEach((mass, i) => {
    for (let q = 3 * i; q < 3 * i + 3; ++q) sum += mass * (positions[q] - right[q]) ** 2;
    weight += mass;
  });
  return Math.sqrt(sum / weight);
}

/**
 * Where runs on three meshes lead, each with edges half as long as the one before: by the rate at
 * which the distances [m] between successive ones fall, log2(d1/d2), at the vertices of the first,
 * whose masses are given. Without a limit where they do not fall.
 */
export function observedLimit([coarse, middle, fine], masses) {
  const distances = [positionError(coarse, middle, masses), positionError(middle, fine, masses)];
  const rate = Math.log2(distances[0] / distances[1]);
  const share = rate > 0 ? 1 / (2 ** rate - 1) : Number.NaN;
  const limit = coarse.map((_, q) => fine[q] + share * (fine[q] - middle[q]));
  return { limit, rate, distances };
}

/** True for a run that came to its end: only then its numbers are of what was asked for. */
export function hasFinished({ status }) {
  return status === 'ok' || status === 'not_converged';
}

/**
 * Runs the contestants in turn, `repeat` rounds, so that a change of the machine's speed meets all
 * of them alike, and makes a row of each. Positions are taken in the first round.
 *
 * contestants: [{label, scene, vertices, method, run: async (times) => run}]
 */
export async function measure(contestants, { repeat, times, against, masses, commit, tell }) {
  if (!against?.reference?.id)
    throw new Error('no error, no row: a row names what it is measured against');
  const rounds = contestants.map(() => []);
  for (let round = 0; round < repeat; ++round) {
    for (const [i, contestant] of contestants.entries()) {
      tell(`round ${round + 1} of ${repeat}: ${contestant.label}`);
      rounds[i].push(await contestant.run(round === 0 ? times : []));
    }
  }
  return contestants.map((contestant, i) =>
    makeRow(contestant, rounds[i], { times, against, masses, commit }),
  );
}

/** What was not measured is NaN, with which no goal is met; JSON has null for it. */
function makeRow(contestant, runs, { times, against, masses, commit }) {
  const [first] = runs;
  const frameTimes = runs.map((run) => median(run.ms));
  const errors = times.map((_, t) =>
    first.samples[t]
      ? positionError(first.samples[t], against.samples[t].positions_m, masses ?? first.masses)
      : Number.NaN,
  );
  return {
    scene: contestant.scene,
    label: contestant.label,
    method: contestant.method,
    n_vertices: contestant.vertices,
    target: first.target,
    ms_per_frame: median(frameTimes),
    ms_per_simulated_second: 60 * median(frameTimes),
    spread_ms: Math.max(...frameTimes) - Math.min(...frameTimes),
    n_runs: runs.length,
    parts_ms: first.parts ?? null,
    rms_stretch: mean(first.rms),
    largest_stretch: mean(first.largest),
    rms_stretch_worst_frame: Math.max(...first.rms),
    position_errors_m: Object.fromEntries(times.map((time, t) => [`${time} s`, errors[t]])),
    position_error_m: errors.at(-1),
    position_error_percent: (100 * errors.at(-1)) / against.rest_diagonal_m,
    residual: first.residual ?? null,
    reference: against.reference,
    status: first.status,
    message: first.message,
    commit,
    process_peak_memory_bytes: first.memory ?? null,
  };
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
export function goal(name, value, direction, bound, rows) {
  const isMeasured = rows.every(hasFinished) && Number.isFinite(value) && Number.isFinite(bound);
  const ok = isMeasured && (direction === 'at-most' ? value <= bound : value >= bound);
  return {
    name,
    ok,
    line: `goal ${name} ${short(value)} ${direction} ${short(bound)} ${ok ? 'ok' : 'short'}`,
  };
}
