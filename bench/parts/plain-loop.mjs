// The plain JavaScript loop of the yardstick in scenes that it does not have: places to begin from, pins that move, a ball.
import { turnsOf } from './contestants.mjs';
import { makeSheet, stretch } from './yardstick.mjs';

/**
 * A sheet of the yardstick's in rows, held by 'edge', 'corners' or 'none'.
 *
 * placeOf: (u, v) => [x, y, z] of a vertex at u [m] along the rows and v across them
 * masses: of each vertex [kg]
 * ball: {centre, radius, friction}, or undefined
 * pinsMove: (time) => how far a pin at x = 0 has gone [x, y, z], those at the other end as far back [m]
 */
function loopSheet(n, { pins, placeOf, masses, ball, pinsMove }) {
  const sheet = makeSheet(n, 'rows', pins === 'none' ? 'corners' : pins);
  if (pins === 'none') sheet.w.fill(1);
  for (const [i, mass] of masses.entries()) if (sheet.w[i] > 0) sheet.w[i] = 1 / mass;
  for (let i = 0; i < n * n; ++i)
    placeOf(sheet.x[3 * i], sheet.x[3 * i + 2]).forEach((value, k) => {
      sheet.x[3 * i + k] = value;
    });
  return { ...sheet, ball, pinsMove, begin: sheet.x.slice(), steps: 0 };
}

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

function placePins({ x, w, begin, pinsMove }, time) {
  const offset = pinsMove(time);
  for (let i = 0; i < w.length; ++i)
    if (w[i] === 0)
      for (let k = 0; k < 3; ++k)
        x[3 * i + k] = begin[3 * i + k] + (begin[3 * i] < 0.5 ? offset[k] : -offset[k]);
}

/** A frame of the yardstick, with the ball after each substep's projections. */
function loopFrame(sheet, substeps, dt = 1 / 60) {
  const { x, v, p, w, ij, rest, ball } = sheet;
  const h = dt / substeps;
  for (let s = 0; s < substeps; ++s) {
    sheet.steps += 1;
    if (sheet.pinsMove) placePins(sheet, sheet.steps * h);
    for (let i = 0; i < w.length; ++i) {
      if (w[i] === 0) continue;
      v[3 * i + 1] -= 9.81 * h;
      for (let q = 3 * i; q < 3 * i + 3; ++q) {
        p[q] = x[q];
        x[q] += h * v[q];
      }
    }
    for (let k = 0; k < rest.length; ++k) {
      const i = ij[2 * k];
      const j = ij[2 * k + 1];
      const wa = w[i];
      const wb = w[j];
      if (wa + wb === 0) continue;
      const a = 3 * i;
      const b = 3 * j;
      const dx = x[a] - x[b];
      const dy = x[a + 1] - x[b + 1];
      const dz = x[a + 2] - x[b + 2];
      const length = Math.sqrt(dx * dx + dy * dy + dz * dz);
      if (length === 0) continue;
      const f = (rest[k] - length) / (length * (wa + wb));
      x[a] += wa * f * dx;
      x[a + 1] += wa * f * dy;
      x[a + 2] += wa * f * dz;
      x[b] -= wb * f * dx;
      x[b + 1] -= wb * f * dy;
      x[b + 2] -= wb * f * dz;
    }
    if (ball) holdOff(sheet, ball);
    for (let i = 0; i < w.length; ++i)
      if (w[i] > 0) for (let q = 3 * i; q < 3 * i + 3; ++q) v[q] = (x[q] - p[q]) / h;
  }
}

/** Stretch beyond which it is no cloth any more. */
const kFlownApart = 1e3;

/** The loop as a contestant, see turnsOf. */
export function loopTurns(n, scene, substeps, frames, times) {
  const sheet = loopSheet(n, scene);
  const program = {
    target: 'javascript',
    step: () => loopFrame(sheet, substeps),
    look: () => {
      const { rms, max } = stretch(sheet);
      if (!(max < kFlownApart)) return { status: 'diverged', message: 'the loop flew apart' };
      return { status: 'ok', rms_stretch: rms, largest_stretch: max };
    },
    positions: () => sheet.x,
    end: () => ({ masses_kg: scene.masses, n_constraints: sheet.rest.length }),
  };
  return turnsOf(program, frames, times);
}
