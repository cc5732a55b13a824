// Key shapes in closed form, as OBJ files: what `bench modes` fills in between.
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';

/** A grid of cells around a box of these sides, its vertices each once and wound outward. */
function boxSurface([a, b, c], cellsOf) {
  const [nx, ny, nz] = cellsOf;
  const numbers = new Map();
  const vertices = [];
  const vertex = (i, j, k) => {
    const key = `${i},${j},${k}`;
    if (!numbers.has(key)) {
      numbers.set(key, vertices.length);
      vertices.push([(i / nx - 0.5) * a, (j / ny - 0.5) * b, (k / nz - 0.5) * c]);
    }
    return numbers.get(key);
  };
  const triangles = [];
  const side = (n, m, at, turned) => {
    for (let p = 0; p < n; ++p)
      for (let q = 0; q < m; ++q) {
        const corners = [at(p, q), at(p + 1, q), at(p + 1, q + 1), at(p, q + 1)];
        if (turned) corners.reverse();
        triangles.push([corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]);
      }
  };
  for (const end of [false, true]) {
    side(ny, nz, (p, q) => vertex(end ? nx : 0, p, q), !end);
    side(nz, nx, (p, q) => vertex(q, end ? ny : 0, p), !end);
    side(nx, ny, (p, q) => vertex(p, q, end ? nz : 0), !end);
  }
  return { vertices, triangles };
}

/** n x n vertices in the plane z = 0, 1 m wide. */
function sheetSurface(n) {
  const vertices = [];
  const triangles = [];
  for (let j = 0; j < n; ++j)
    for (let i = 0; i < n; ++i) vertices.push([i / (n - 1) - 0.5, j / (n - 1) - 0.5, 0]);
  for (let j = 0; j + 1 < n; ++j)
    for (let i = 0; i + 1 < n; ++i) {
      const [a, b, c, d] = [j * n + i, j * n + i + 1, (j + 1) * n + i + 1, (j + 1) * n + i];
      triangles.push([a, b, c], [a, c, d]);
    }
  return { vertices, triangles };
}

/** Bent to an arc of so many radians, the line y = 0 (of a sheet z = 0) keeping its length. */
function bent([x, y, z], length, angle) {
  if (angle === 0) return [x, y, z];
  const radius = length / angle;
  const turn = x / radius;
  return [(radius - y) * Math.sin(turn), radius - (radius - y) * Math.cos(turn), z];
}

function write(folder, name, { triangles }, vertices) {
  const file = join(folder, `${name}.obj`);
  const lines = vertices.map((v) => `v ${v.join(' ')}`);
  for (const corners of triangles) lines.push(`f ${corners.map((v) => v + 1).join(' ')}`);
  writeFileSync(file, `${lines.join('\n')}\n`);
  return file;
}

/** A bar along x, straight and then bent by these angles [rad]; one file a key. */
export function barKeys(folder, sides, cells, angles) {
  const bar = boxSurface(sides, cells);
  return [0, ...angles].map((angle, k) =>
    write(
      folder,
      `bar-${cells.join('-')}-${k}`,
      bar,
      bar.vertices.map((v) => bent(v, sides[0], angle)),
    ),
  );
}

/** A sheet of n x n vertices that is rolled to one side and the other, more and more. */
export function sheetKeys(folder, n, nKeys) {
  const sheet = sheetSurface(n);
  return Array.from({ length: nKeys }, (_, k) => {
    const angle = 0.5 * k * (k % 2 ? -1 : 1);
    const rolled = sheet.vertices.map(([x, y]) => {
      const [px, pz] = bent([x, 0, 0], 1, angle);
      return [px, y, pz];
    });
    return write(folder, `sheet-${n}-${k}`, sheet, rolled);
  });
}
