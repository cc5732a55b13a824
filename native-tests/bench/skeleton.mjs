// ./pleat bench skeleton [--json FILE] [--check] [--repeat N] [--only PART,...]
// Speed and error of every stepper against each other, the same core as WebAssembly, and a plain
// JavaScript loop. Bounds in milliseconds hold where that loop (sheet 65x65, 100 substeps, row
// order) takes 20 ms, and are scaled by what it takes here.
import { execFileSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { parseArgs } from 'node:util';

import { goal, measure, median, table } from './bench-rows.mjs';
import { nativeRun, reference, root, wasmRun, yardstickRun } from './contestants.mjs';

const kFrames = 60; // one second, the stretch of motion that positions are compared over
const kStep = 1 / 60; // [s]
const kTimes = [0.5, 1]; // [s]
const kYardstickMs = 20; // that the bounds in ms are made for

const { values: options } = parseArgs({
  options: {
    json: { type: 'string' },
    check: { type: 'boolean', default: false },
    repeat: { type: 'string', default: '5' },
    only: { type: 'string', default: 'yardstick,projective,implicit,targets,absent' },
  },
});
const repeat = Number(options.repeat);
if (!Number.isInteger(repeat) || repeat < 1) {
  console.error(`bench: --repeat: expected a whole number of at least 1, got "${options.repeat}"`);
  process.exit(2);
}

const commit = (() => {
  try {
    return execFileSync('git', ['-C', root, 'describe', '--always', '--dirty'], {
      encoding: 'utf8',
    }).trim();
  } catch {
    return 'unknown';
  }
})();
const tell = (text) => process.stderr.write(process.stderr.isTTY ? `\r\x1b[K${text}` : `${text}\n`);
const settings = (times) => ({ repeat, times, commit, tell });

/**
 * A sheet of n x n vertices let go from the horizontal, its upper edge held. Vertices are numbered
 * as the yardstick's are.
 */
function swingingSheet(n, method, more = {}) {
  return {
    name: `swinging sheet ${n}x${n}`,
    cloth: {
      sheet: {
        width_m: 1,
        height_m: 1,
        columns: n - 1,
        rows: n - 1,
        origin_m: [0, 0, 0],
        warp_direction: [0, 0, 1],
        weft_direction: [1, 0, 0],
      },
    },
    fabric: { name: 'fine cotton' },
    pins: [{ part: 'upper_edge' }],
    method: { step_s: kStep, ...method },
    duration_s: 1,
    ...more,
  };
}

/**
 * 65x65 vertices hung by two corners that come together to half their distance within a second,
 * let go from the horizontal as the yardstick is, or hanging already.
 */
function cornersMeet(method, begin = 'horizontal') {
  const comeTogether = (offset) => ({
    kind: 'ease',
    offset_m: [offset, 0, 0],
    begin_s: 0,
    end_s: 1,
  });
  return {
    name: `corners meet 65x65, ${begin}`,
    cloth: {
      sheet: {
        width_m: 1,
        height_m: 1,
        columns: 64,
        rows: 64,
        origin_m: [-0.5, 1.5, 0],
        warp_direction: begin === 'horizontal' ? [0, 0, 1] : [0, -0.94, 0.342],
        weft_direction: [1, 0, 0],
      },
    },
    fabric: { name: 'fine cotton' },
    pins: [
      { part: 'upper_left', motion: comeTogether(0.25) },
      { part: 'upper_right', motion: comeTogether(-0.25) },
    ],
    method: { step_s: kStep, ...method },
    duration_s: 1,
  };
}

function contestant(target, label, scene, n, frames = kFrames) {
  const run = target === 'wasm' ? wasmRun : nativeRun;
  return {
    label: `${scene.name}, ${label}`,
    scene: scene.name,
    method: scene.method,
    vertices: n * n,
    run: (times) => run(scene, frames, times),
  };
}

function yardstick(n, substeps, order, masses) {
  return {
    label: `swinging sheet ${n}x${n}, yardstick ${order}, ${substeps} substeps`,
    scene: `swinging sheet ${n}x${n}`,
    method: { stepper: `yardstick ${order}`, step_s: kStep, substeps },
    vertices: n * n,
    run: async (times) => yardstickRun(n, substeps, order, kFrames, times, masses),
  };
}

/** What the yardstick takes here, over what the bounds were made for. */
function machineScale() {
  const times = [];
  for (let round = 0; round < repeat; ++round) {
    tell(`yardstick, round ${round + 1} of ${repeat}`);
    times.push(yardstickRun(65, 100, 'rows', 30, []));
  }
  const ms = median(times.map((run) => median(run.ms)));
  const nsPerConstraint = (1e6 * ms) / (100 * times[0].constraints);
  console.log(
    `yardstick 65x65, 100 substeps, rows: ${ms.toFixed(2)} ms, ${nsPerConstraint.toFixed(2)} ns per constraint;`,
  );
  console.log(`bounds in ms are scaled by ${(ms / kYardstickMs).toFixed(3)}\n`);
  return ms / kYardstickMs;
}

/** xpbd against the yardstick: same substeps, constraints and masses, no bending, compliance 0. */
async function againstYardstick() {
  const rows = [];
  const goals = [];
  for (const n of [33, 65, 129]) {
    for (const substeps of [30, 100]) {
      const method = { stepper: 'xpbd', substeps, iterations: 1, constraints: 'rigid' };
      const scene = swingingSheet(n, method, { model: { bending: 'none' } });
      const { masses } = nativeRun(scene, 2, []);
      const label = `xpbd, ${substeps} substeps`;
      const found = await measure(
        [
          contestant('wasm', label, scene, n),
          contestant('native', label, scene, n),
          yardstick(n, substeps, 'rows', masses),
          yardstick(n, substeps, 'coloured', masses),
        ],
        { ...settings(kTimes), against: reference(scene, 'rigid_chain', kTimes), masses },
      );
      rows.push(...found);
      const [ours, , byRows, coloured] = found;
      const name = `xpbd_${n}_${substeps}`;
      const least = (value) => Math.min(value(byRows), value(coloured));
      goals.push(
        goal(
          `${name}_times_faster_than_rows`,
          byRows.ms_per_frame / ours.ms_per_frame,
          'at-least',
          4,
        ),
        goal(
          `${name}_times_faster_than_coloured`,
          coloured.ms_per_frame / ours.ms_per_frame,
          'at-least',
          3,
        ),
        goal(
          `${name}_rms_stretch`,
          ours.rms_stretch,
          'at-most',
          least((row) => row.rms_stretch),
        ),
        goal(
          `${name}_largest_stretch`,
          ours.largest_stretch,
          'at-most',
          least((row) => row.largest_stretch),
        ),
      );
      for (const time of kTimes) {
        const error = (row) => row.position_errors_m[`${time} s`];
        goals.push(
          goal(`${name}_position_error_m_at_${time}_s`, error(ours), 'at-most', least(error)),
        );
      }
    }
  }
  return { rows, goals };
}

async function projective(scale) {
  const times = [1];
  // One round in each of ten substeps: more substeps answer sooner than more rounds.
  const method = { stepper: 'projective', substeps: 10, iterations: 1 };
  const coarse = { stepper: 'implicit', solver: 'cholmod', substeps: 1 };
  const label = 'projective, 10 substeps of 1 round';
  const rows = [];
  for (const begin of ['horizontal', 'hanging']) {
    const fine = cornersMeet({ ...coarse, substeps: 16 }, begin);
    rows.push(
      ...(await measure(
        [
          contestant('wasm', label, cornersMeet(method, begin), 65),
          contestant('native', label, cornersMeet(method, begin), 65),
          contestant('native', 'implicit, 1/60 s', cornersMeet(coarse, begin), 65),
        ],
        { ...settings(times), against: reference(fine, 'run', times) },
      )),
    );
  }
  const [ours, , implicitRow] = rows;
  return {
    rows,
    goals: [
      goal('projective_rms_stretch_percent', 100 * ours.rms_stretch_worst_frame, 'at-most', 0.4),
      goal('projective_ms_per_frame_wasm', ours.ms_per_frame, 'at-most', 6 * scale),
      goal(
        'projective_position_error_m_at_1_s',
        ours.position_error_m,
        'at-most',
        implicitRow.position_error_m,
      ),
    ],
  };
}

async function implicit(scale) {
  const n = 100;
  const method = (more) => swingingSheet(n, { stepper: 'implicit', substeps: 1, ...more });
  const loose = method({ solver: 'cg', tolerance: 1e-2 });
  const rows = await measure(
    [
      contestant('native', 'implicit, cg to 1e-2', loose, n),
      contestant('native', 'implicit, cg to 1e-3', method({ solver: 'cg', tolerance: 1e-3 }), n),
      contestant('native', 'implicit, cholmod', method({ solver: 'cholmod' }), n),
    ],
    { ...settings(kTimes), against: reference(loose, 'rigid_chain', kTimes) },
  );
  return {
    rows,
    goals: [
      goal('implicit_100x100_cg_1e-2_ms_native', rows[0].ms_per_frame, 'at-most', 60 * scale),
    ],
  };
}

/** The float64 steppers in both builds on the same scene. */
async function targets() {
  const n = 33;
  const methods = {
    explicit: { stepper: 'explicit', substeps: 'stable' },
    implicit_cg: { stepper: 'implicit', substeps: 1, solver: 'cg', tolerance: 1e-3 },
    implicit_cholmod: { stepper: 'implicit', substeps: 1, solver: 'cholmod' },
    projective: { stepper: 'projective', substeps: 1, iterations: 10, solver: 'cholmod' },
  };
  const rows = [];
  const goals = [];
  for (const [name, method] of Object.entries(methods)) {
    const scene = swingingSheet(n, method);
    const frames = name === 'explicit' ? 6 : kFrames; // of 12 000 substeps each
    const times = name === 'explicit' ? [0.1] : kTimes;
    const found = await measure(
      [contestant('wasm', name, scene, n, frames), contestant('native', name, scene, n, frames)],
      { ...settings(times), against: reference(scene, 'rigid_chain', times) },
    );
    rows.push(...found);
    goals.push(
      goal(`wasm_over_native_${name}`, found[0].ms_per_frame / found[1].ms_per_frame, 'at-most', 2),
    );
  }
  return { rows, goals };
}

/**
 * What a scene does not ask for costs nothing: without it a frame is no slower than with it, there
 * but without effect.
 */
async function absent() {
  const n = 65;
  const kNoise = 1.05; // interleaved medians differ by less
  const method = { stepper: 'xpbd', substeps: 30, iterations: 1 };
  const limp = { model: { bending: 'none' } };
  const faint = { name: 'fine cotton', overrides: { bend_warp_n_m: 1e-15, bend_weft_n_m: 1e-15 } };
  const farBelow = { plane: { point_m: [0, -100, 0], normal: [0, 1, 0] } };
  const scenes = {
    plain: swingingSheet(n, method, limp),
    bending: swingingSheet(n, method, { fabric: faint }),
    air: swingingSheet(n, method, { ...limp, world: { air: { density_kg_per_m3: 1e-9 } } }),
    contact: swingingSheet(n, method, { ...limp, world: { colliders: [farBelow] } }),
  };
  const against = reference(scenes.plain, 'rigid_chain', kTimes);
  const rows = await measure(
    Object.entries(scenes).map(([name, scene]) => contestant('wasm', `xpbd, ${name}`, scene, n)),
    { ...settings(kTimes), against },
  );
  const [plain, ...others] = rows;
  return {
    rows,
    goals: others.map((row, i) =>
      goal(
        `absent_${Object.keys(scenes)[i + 1]}_costs`,
        plain.ms_per_frame / row.ms_per_frame,
        'at-most',
        kNoise,
      ),
    ),
  };
}

const parts = { yardstick: againstYardstick, projective, implicit, targets, absent };
const wanted = options.only.split(',');
const unknown = wanted.find((name) => !(name in parts));
if (unknown !== undefined) {
  console.error(
    `bench: --only: expected some of ${Object.keys(parts).join(', ')}, got "${unknown}"`,
  );
  process.exit(2);
}
const scale = machineScale();
const rows = [];
const goals = [];
for (const name of wanted) {
  const part = await parts[name](scale);
  if (process.stderr.isTTY) tell('');
  console.log(
    `${name}: errors against ${[...new Set(part.rows.map((row) => row.reference.description))].join('; ')}\n`,
  );
  console.log(`${table(part.rows)}\n`);
  rows.push(...part.rows);
  goals.push(...part.goals);
}
for (const { line } of goals) console.log(line);
if (options.json)
  writeFileSync(options.json, rows.map((row) => `${JSON.stringify(row)}\n`).join(''));
if (options.check && goals.some(({ ok }) => !ok)) process.exitCode = 1;
