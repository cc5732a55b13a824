// Cloth in the wind and cloth on a ball, as the scenes have them and of another fabric, by the
// position-based steppers: cost, stretch, and how deep the deepest vertex gets into the ball.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

import { commit, tell } from './bench-parts.mjs';
import { goal, markdown, median, short } from './bench-rows.mjs';
import { nativeRun, root } from './command.mjs';

const kFramesPerSecond = 60;
const kSubsteps = 10; // of all alike, as the scenes have it
const kMostDepthMm = 1e-3;

const kSteppers = ['pbd', 'hpbd', 'multigrid', 'xpbd'];
const kPromised = kSteppers.slice(0, 3); // of these the goals are

/** A scene, and the fabric that it is run with beside its own. */
const kScenes = { wind: 'silk', ball: 'fine cotton' };

const read = (name) =>
  JSON.parse(readFileSync(join(root, 'assets', 'scenes', `${name}.json`), 'utf8'));

const sphereOf = (scene) => scene.world.colliders.find(({ sphere }) => sphere)?.sphere;

/** The least distance of a vertex to the ball's surface in all samples [m]; below 0 inside. */
function nearest(samples, { centre_m: centre, radius_m: radius }) {
  let least = Number.POSITIVE_INFINITY;
  for (const { positions_m: x } of samples)
    for (let i = 0; i < x.length; i += 3) {
      const distance = Math.hypot(x[i] - centre[0], x[i + 1] - centre[1], x[i + 2] - centre[2]);
      // Math.min and comparisons would pass over NaN.
      if (!(distance - radius >= least)) least = distance - radius;
    }
  return least;
}

/** NaN where one is none. */
const largest = (values) => Math.max(...values.map((value) => value ?? Number.NaN));

/** How many numbers of a run are none: JSON writes them as null. */
function notFinite({ samples, rms_stretch, largest_stretch }) {
  const lists = [...samples.map(({ positions_m }) => positions_m), rms_stretch, largest_stretch];
  return lists.reduce((sum, list) => sum + list.filter((x) => !Number.isFinite(x)).length, 0);
}

function rowOf(name, scene, fabric, stepper, repeat) {
  tell(`${name}, ${fabric}: ${stepper}`);
  const frames = Math.round(scene.duration_s * kFramesPerSecond);
  const method = { stepper, step_s: 1 / kFramesPerSecond, substeps: kSubsteps };
  const run = { ...scene, fabric: { name: fabric }, method };
  const times = Array.from({ length: frames - 1 }, (_, k) => (k + 2) / kFramesPerSecond);
  const seen = nativeRun(run, frames, times);
  const more = Array.from({ length: repeat - 1 }, () => nativeRun(run, frames));
  const ms = [seen, ...more].map((each) => median(each.ms));
  const sphere = sphereOf(scene);
  const gap = sphere ? nearest(seen.samples, sphere) : undefined;
  return {
    scene: name,
    fabric,
    method,
    n_vertices: seen.n_vertices,
    ms_per_frame: median(ms),
    spread_ms: Math.max(...ms) - Math.min(...ms),
    rms_stretch: largest(seen.rms_stretch),
    largest_stretch: largest(seen.largest_stretch),
    last_rms_stretch: seen.rms_stretch.at(-1),
    ...(sphere && { ball_gap_mm: 1e3 * gap, ball_depth_mm: 1e3 * Math.max(0, -gap) }),
    n_not_finite: notFinite(seen) + (frames - seen.rms_stretch.length),
    status: seen.status,
    commit,
  };
}

export function experiments({ repeat }) {
  const rows = [];
  for (const [name, other] of Object.entries(kScenes)) {
    const { $schema, ...scene } = read(name);
    for (const fabric of [scene.fabric.name, other])
      for (const stepper of kSteppers) rows.push(rowOf(name, scene, fabric, stepper, repeat));
  }
  const of = (name) =>
    rows.filter((row) => row.scene === name && kPromised.includes(row.method.stepper));
  const notFiniteIn = (name) => of(name).reduce((sum, row) => sum + row.n_not_finite, 0);
  const lines = rows.map((row) => [
    row.scene,
    row.fabric,
    row.method.stepper,
    row.n_vertices,
    short(row.ms_per_frame),
    short(row.spread_ms),
    short(100 * row.rms_stretch),
    short(100 * row.last_rms_stretch),
    short(100 * row.largest_stretch),
    row.ball_depth_mm === undefined ? '' : short(row.ball_depth_mm),
    row.ball_gap_mm === undefined ? '' : short(row.ball_gap_mm),
    row.n_not_finite,
    row.status,
  ]);
  const head = [
    'scene',
    'fabric',
    'method',
    'vertices',
    'ms/frame',
    'spread',
    'rms stretch %',
    'last %',
    'largest %',
    'depth mm',
    'nearest mm',
    'not finite',
    'status',
  ];
  return {
    rows,
    goals: [
      goal('wind_not_finite', notFiniteIn('wind'), 'at-most', 0, of('wind')),
      goal('ball_not_finite', notFiniteIn('ball'), 'at-most', 0, of('ball')),
      goal(
        'ball_depth_mm',
        largest(of('ball').map((row) => row.ball_depth_mm)),
        'at-most',
        kMostDepthMm,
        of('ball'),
      ),
    ],
    text: `${kSubsteps} substeps of 1/600 s; stretch in the worst frame, RMS of the last one too; places of every frame\n\n${markdown(head, lines)}`,
  };
}
