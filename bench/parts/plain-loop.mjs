// The plain JavaScript loop of the yardstick as a contestant, also in scenes that the yardstick does
// not have: places to start from, pins that move, a ball.
import v8 from 'node:v8';

import { turnsOf } from './contestants.mjs';
import { kStep } from './sheets.mjs';
import { frame, makeSheet, stretch } from './yardstick.mjs';

/** Stretch beyond which it is no cloth any more. */
const kFlownApart = 1e3;

/** Vertices inside are put onto the ball; what they moved along it is less by friction times the depth. */
function holdOff({ x, p, w }, { centre, radius, friction }) {
  for (let i = 0; i < w.length; ++i) {
    const q = 3 * i;
    const dx = x[q] - centre[0];
    const dy = x[q + 1] - centre[1];
    const dz = x[q + 2] - centre[2];
    const distance = Math.sqrt(dx * dx + dy * dy + dz * dz);
    if (distance >= radius || w[i] === 0) continue;
    const depth = radius - distance;
    const nx = dx / distance;
    const ny = dy / distance;
    const nz = dz / distance;
    x[q] += depth * nx;
    x[q + 1] += depth * ny;
    x[q + 2] += depth * nz;
    const mx = x[q] - p[q];
    const my = x[q + 1] - p[q + 1];
    const mz = x[q + 2] - p[q + 2];
    const along = mx * nx + my * ny + mz * nz;
    const tx = mx - along * nx;
    const ty = my - along * ny;
    const tz = mz - along * nz;
    const slip = Math.sqrt(tx * tx + ty * ty + tz * tz);
    if (slip === 0) continue;
    const held = Math.min(1, (friction * depth) / slip);
    x[q] -= held * tx;
    x[q + 1] -= held * ty;
    x[q + 2] -= held * tz;
  }
}

function placePins({ x, w }, begin, offset) {
  for (let i = 0; i < w.length; ++i)
    if (w[i] === 0)
      for (let k = 0; k < 3; ++k)
        x[3 * i + k] = begin[3 * i + k] + (begin[3 * i] < 0.5 ? offset[k] : -offset[k]);
}

/**
 * A sheet of the yardstick's.
 *
 * order: of its constraints, 'rows' or 'coloured';  pins: 'edge', 'corners' or 'none'
 * placeOf: (u, v) => [x, y, z] of a vertex at u [m] along the rows and v across them
 * masses: of each vertex [kg], where it is not pinned
 * ball: {centre, radius, friction}
 * pinsMove: (time) => how far a pin at x = 0 has gone [x, y, z], those at the other end as far back [m]
 */
function loopSheet(n, { order = 'rows', pins = 'edge', placeOf, masses = [], ball, pinsMove }) {
  const sheet = makeSheet(n, order, pins === 'none' ? 'corners' : pins);
  const { x, w } = sheet;
  if (pins === 'none') w.fill(1);
  for (const [i, mass] of masses.entries()) if (w[i] > 0) w[i] = 1 / mass;
  for (let q = 0; placeOf && q < x.length; q += 3) x.set(placeOf(x[q], x[q + 2]), q);
  if (ball) sheet.after = () => holdOff(sheet, ball);
  const begin = x.slice();
  let steps = 0;
  if (pinsMove) sheet.before = (h) => placePins(sheet, begin, pinsMove(++steps * h));
  return sheet;
}

/** The loop as a contestant on the n x n vertices of `scene`; `about` as of loopSheet, and its name. */
export function loopContestant(scene, n, substeps, { name = 'loop', ...about }, frames = 60) {
  const begin = (times) => {
    const sheet = loopSheet(n, about);
    const program = {
      target: 'javascript',
      step: () => frame(sheet, substeps),
      look: () => {
        const { rms, max } = stretch(sheet);
        if (!(max < kFlownApart)) return { status: 'diverged', message: 'the loop flew apart' };
        return { status: 'ok', rms_stretch: rms, largest_stretch: max };
      },
      positions: () => sheet.x,
      end: () => ({ masses_kg: about.masses, n_constraints: sheet.rest.length }),
    };
    return turnsOf(program, frames, times);
  };
  const label = `${scene}, ${name}, ${substeps} substeps`;
  return { label, scene, method: { stepper: name, step_s: kStep, substeps }, begin };
}

/**
 * Runs the loop in both orders until V8 has compiled it for good, and at once, not beside it: its
 * code is then the same in all turns.
 */
export function warmUpLoop() {
  const kWarmMs = 300; // processor time, in each order
  v8.setFlagsFromString('--no-concurrent-recompilation');
  for (const order of ['rows', 'coloured']) {
    const sheet = makeSheet(33, order);
    const begin = process.cpuUsage().user;
    while (process.cpuUsage().user - begin < 1e3 * kWarmMs) frame(sheet, 30);
  }
}
