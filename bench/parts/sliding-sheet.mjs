// Ways off a ball that are computed here: of a bead, and of a sheet of springs in small steps.
// Neither shares code with the core; constants of springs are those of docs/methods/springs.md.

/**
 * A bead on a ball of radius R from the angle `begin` off its top: [across, up] after `seconds`,
 * about the ball's centre. On it R a'' = g sin a - mu (g cos a - R a'^2); where that bracket is 0
 * it leaves and falls. Second-order steps of 10 us.
 */
export function beadOnBall({ radius, begin, mu, seconds, gravity = 9.81 }) {
  const kStep = 1e-5; // [s]
  let [angle, turn] = [begin, 0];
  const turning = (a, w) => {
    const pressed = (gravity * Math.cos(a)) / radius - w * w;
    return (gravity * Math.sin(a)) / radius - mu * Math.max(pressed, 0);
  };
  let time = 0;
  for (; time < seconds - kStep / 2; time += kStep) {
    if (gravity * Math.cos(angle) < radius * turn ** 2) break;
    const half = turn + (kStep / 2) * Math.max(turning(angle, turn), 0);
    const middle = angle + (kStep / 2) * turn;
    angle += kStep * half;
    turn += kStep * Math.max(turning(middle, half), 0);
  }
  const left = Math.max(seconds - time, 0);
  const [s, c] = [Math.sin(angle), Math.cos(angle)];
  const speed = radius * turn;
  return [radius * s + speed * c * left, radius * c - speed * s * left - (gravity * left ** 2) / 2];
}

/** Pairs and constants of springs of n x n square cells: along threads and on diagonals. */
function springsOf(n, cell, fabric) {
  const line = n + 1;
  const springs = [];
  const add = (a, b, stiffness, length) => springs.push({ a, b, stiffness, length });
  const isBorder = (k) => k === 0 || k === n;
  for (let r = 0; r <= n; ++r)
    for (let c = 0; c <= n; ++c) {
      const i = r * line + c;
      const warp = (fabric.warp - fabric.shear) * (isBorder(c) ? 0.5 : 1);
      const weft = (fabric.weft - fabric.shear) * (isBorder(r) ? 0.5 : 1);
      if (r < n) add(i, i + line, warp, cell);
      if (c < n) add(i, i + 1, weft, cell);
      if (r < n && c < n) {
        add(i, i + line + 1, fabric.shear, cell * Math.SQRT2);
        add(i + 1, i + line, fabric.shear, cell * Math.SQRT2);
      }
    }
  return springs;
}

/** [x0, x1, x2, constant] of bending elements: B w/L^3 |x0 - 2 x1 + x2|^2/2. */
function bendsOf(n, cell, fabric) {
  const line = n + 1;
  const bends = [];
  const isBorder = (k) => k === 0 || k === n;
  const share = (k) => (isBorder(k) ? 0.5 : 1) / cell ** 2;
  for (let r = 0; r <= n; ++r)
    for (let c = 0; c <= n; ++c) {
      const i = r * line + c;
      if (r > 0 && r < n) bends.push([i - line, i, i + line, fabric.bendWarp * share(c)]);
      if (c > 0 && c < n) bends.push([i - 1, i, i + 1, fabric.bendWeft * share(r)]);
    }
  return bends;
}

/**
 * A square sheet of n x n cells on a ball about the origin: the mean place of its vertices after
 * `seconds`. Symplectic Euler; vertices that come nearer than `reach` are put onto it along the
 * radius, lose their speed towards it, and of that along it mu times as much at most.
 *
 * positions: [x, y, z] of each vertex at the start, at rest, row by row along warp
 * fabric: {density, warp, weft, shear, bendWarp, bendWeft}
 * step: [s], below 2 over the fastest frequency
 */
export function sheetOnBall({ positions, n, cell, fabric, reach, mu, seconds, step }) {
  const line = n + 1;
  const x = Float64Array.from(positions.flat());
  const v = new Float64Array(x.length);
  const f = new Float64Array(x.length);
  const springs = springsOf(n, cell, fabric);
  const ends = Int32Array.from(springs.flatMap(({ a, b }) => [3 * a, 3 * b]));
  const stiffness = Float64Array.from(springs.map((spring) => spring.stiffness));
  const lengths = Float64Array.from(springs.map((spring) => spring.length));
  const bends = bendsOf(n, cell, fabric);
  const threes = Int32Array.from(bends.flatMap(([a, b, c]) => [3 * a, 3 * b, 3 * c]));
  const rigidity = Float64Array.from(bends.map(([, , , constant]) => constant));
  const mass = Float64Array.from(positions, (_, i) => {
    const half = (k) => (k === 0 || k === n ? 0.5 : 1);
    return fabric.density * cell ** 2 * half(i % line) * half(Math.floor(i / line));
  });
  const steps = Math.round(seconds / step);
  const h = seconds / steps;
  for (let count = 0; count < steps; ++count) {
    f.fill(0);
    for (let s = 0; s < stiffness.length; ++s) {
      const [a, b] = [ends[2 * s], ends[2 * s + 1]];
      const [dx, dy, dz] = [x[b] - x[a], x[b + 1] - x[a + 1], x[b + 2] - x[a + 2]];
      const length = Math.sqrt(dx * dx + dy * dy + dz * dz);
      const pull = (stiffness[s] * (length - lengths[s])) / length;
      f[a] += pull * dx;
      f[a + 1] += pull * dy;
      f[a + 2] += pull * dz;
      f[b] -= pull * dx;
      f[b + 1] -= pull * dy;
      f[b + 2] -= pull * dz;
    }
    for (let e = 0; e < rigidity.length; ++e)
      for (let k = 0; k < 3; ++k) {
        const [a, b, c] = [threes[3 * e] + k, threes[3 * e + 1] + k, threes[3 * e + 2] + k];
        const pull = rigidity[e] * (x[a] - 2 * x[b] + x[c]);
        f[a] -= pull;
        f[b] += 2 * pull;
        f[c] -= pull;
      }
    for (let i = 0; i < x.length; i += 3) {
      const m = mass[i / 3];
      for (let k = 0; k < 3; ++k) v[i + k] += (h * f[i + k]) / m - (k === 1 ? h * 9.81 : 0);
      meetBall(x, v, i, h, reach, mu);
    }
  }
  return [0, 1, 2].map(
    (k) => x.reduce((sum, c, i) => (i % 3 === k ? sum + c : sum), 0) / mass.length,
  );
}

/** Moves a vertex by its velocity, on or outside of the ball. */
function meetBall(x, v, i, h, reach, mu) {
  for (let k = 0; k < 3; ++k) x[i + k] += h * v[i + k];
  const far = Math.hypot(x[i], x[i + 1], x[i + 2]);
  if (far >= reach) return;
  const normal = [x[i] / far, x[i + 1] / far, x[i + 2] / far];
  const inward = normal[0] * v[i] + normal[1] * v[i + 1] + normal[2] * v[i + 2];
  const change = Math.max(-inward, 0);
  for (let k = 0; k < 3; ++k) {
    x[i + k] = reach * normal[k];
    v[i + k] += change * normal[k];
  }
  if (mu === 0 || change === 0) return;
  const out = normal[0] * v[i] + normal[1] * v[i + 1] + normal[2] * v[i + 2];
  const along = normal.map((n, k) => v[i + k] - out * n);
  const speed = Math.hypot(...along);
  const kept = speed > 0 ? Math.max(0, 1 - (mu * change) / speed) : 0;
  for (let k = 0; k < 3; ++k) v[i + k] = out * normal[k] + kept * along[k];
}
