// Cloth in the wind and cloth on a ball, as the scenes have them and of another fabric, by the
// position-based steppers: cost, stretch, and how deep the deepest vertex gets into the ball.
import { shippedScene } from './assets.mjs';
import { tell } from './bench-options.mjs';
import { atMost, largest, median, spread, table } from './bench-rows.mjs';
import { commit, nativeRun } from './command.mjs';
import { nearest } from './loop-contact.mjs';
import { by } from './sheets.mjs';

const kFramesPerSecond = 60;
const kSubsteps = 10; // substeps of all alike, as the scenes have it
const kMostDepthMm = 1e-3;

const kSteppers = ['pbd', 'hpbd', 'multigrid', 'xpbd'];
const kPromised = kSteppers.slice(0, 3); // steppers that the goals are about

/** A scene, and the fabric that it is run with beside its own. */
const kScenes = { wind: 'silk', ball: 'fine cotton' };

const sphereOf = (scene) => scene.world.colliders.find(({ sphere }) => sphere)?.sphere;

/** How many numbers of a run are none: JSON writes them as null. */
function notFinite({ samples, rms_stretch, largest_stretch }) {
  const lists = [...samples.map(({ positions_m }) => positions_m), rms_stretch, largest_stretch];
  return lists.reduce((sum, list) => sum + list.filter((x) => !Number.isFinite(x)).length, 0);
}

function rowOf(name, scene, fabric, stepper, repeat) {
  tell(`${name}, ${fabric}: ${stepper}`);
  const frames = Math.round(scene.duration_s * kFramesPerSecond);
  const run = by({ ...scene, fabric: { name: fabric } }, { stepper, substeps: kSubsteps });
  const times = Array.from({ length: frames - 1 }, (_, k) => (k + 2) / kFramesPerSecond);
  const seen = nativeRun(run, frames, times);
  const more = Array.from({ length: repeat - 1 }, () => nativeRun(run, frames));
  const ms = [seen, ...more].map((each) => median(each.ms));
  const sphere = sphereOf(scene);
  const gap = sphere ? nearest(seen.samples, sphere.centre_m, sphere.radius_m) : undefined;
  return {
    scene: name,
    fabric,
    method: run.method,
    n_vertices: seen.n_vertices,
    ms_per_frame: median(ms),
    spread_ms: spread(ms),
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
    const scene = shippedScene(name);
    for (const fabric of [scene.fabric.name, other])
      for (const stepper of kSteppers) rows.push(rowOf(name, scene, fabric, stepper, repeat));
  }
  const of = (name) =>
    rows.filter((row) => row.scene === name && kPromised.includes(row.method.stepper));
  const notFiniteIn = (name) => of(name).reduce((sum, row) => sum + row.n_not_finite, 0);
  const deepest = largest(of('ball').map((row) => row.ball_depth_mm));
  const columns = {
    scene: 'scene',
    fabric: 'fabric',
    method: (row) => row.method.stepper,
    vertices: 'n_vertices',
    'ms/frame': 'ms_per_frame',
    spread: 'spread_ms',
    'rms stretch %': (row) => 100 * row.rms_stretch,
    'last %': (row) => 100 * row.last_rms_stretch,
    'largest %': (row) => 100 * row.largest_stretch,
    'depth mm': (row) => row.ball_depth_mm ?? '',
    'nearest mm': (row) => row.ball_gap_mm ?? '',
    'not finite': 'n_not_finite',
    status: 'status',
  };
  return {
    rows,
    goals: [
      atMost('wind_not_finite', notFiniteIn('wind'), 0, of('wind')),
      atMost('ball_not_finite', notFiniteIn('ball'), 0, of('ball')),
      atMost('ball_depth_mm', deepest, kMostDepthMm, of('ball')),
    ],
    text: `${kSubsteps} substeps of 1/600 s; stretch in the worst frame, RMS of the last one too; places of every frame\n\n${table(rows, columns)}`,
  };
}
