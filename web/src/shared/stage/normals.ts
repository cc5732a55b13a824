// Positions and smooth normals of a triangle mesh.
import { BufferAttribute, type BufferGeometry, DynamicDrawUsage } from 'three';

/** Room for three numbers a vertex that change with every frame. */
export function changingTriples(n: number): BufferAttribute {
  return new BufferAttribute(new Float32Array(3 * n), 3).setUsage(DynamicDrawUsage);
}

/** Sums each triangle's area-weighted normal at its corners; the shader normalises. */
function addNormals(positions: Float32Array, triangles: Uint32Array, normals: Float32Array): void {
  normals.fill(0);
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * (triangles[t] as number);
    const b = 3 * (triangles[t + 1] as number);
    const c = 3 * (triangles[t + 2] as number);
    const ux = (positions[b] as number) - (positions[a] as number);
    const uy = (positions[b + 1] as number) - (positions[a + 1] as number);
    const uz = (positions[b + 2] as number) - (positions[a + 2] as number);
    const vx = (positions[c] as number) - (positions[a] as number);
    const vy = (positions[c + 1] as number) - (positions[a + 1] as number);
    const vz = (positions[c + 2] as number) - (positions[a + 2] as number);
    const nx = uy * vz - uz * vy;
    const ny = uz * vx - ux * vz;
    const nz = ux * vy - uy * vx;
    for (const corner of [a, b, c]) {
      normals[corner] = (normals[corner] as number) + nx;
      normals[corner + 1] = (normals[corner + 1] as number) + ny;
      normals[corner + 2] = (normals[corner + 2] as number) + nz;
    }
  }
  for (let v = 0; v < normals.length; v += 3) {
    const length = Math.hypot(
      normals[v] as number,
      normals[v + 1] as number,
      normals[v + 2] as number,
    );
    if (length === 0) continue;
    normals[v] = (normals[v] as number) / length;
    normals[v + 1] = (normals[v + 1] as number) / length;
    normals[v + 2] = (normals[v + 2] as number) / length;
  }
}

/** Takes positions to the screen as they come, without a copy, and makes normals for them. */
export function showPositions(
  geometry: BufferGeometry,
  positions: Float32Array,
  triangles: Uint32Array,
): void {
  const place = geometry.getAttribute('position') as BufferAttribute;
  place.array = positions;
  place.needsUpdate = true;
  const normals = geometry.getAttribute('normal') as BufferAttribute;
  addNormals(positions, triangles, normals.array as Float32Array);
  normals.needsUpdate = true;
}
