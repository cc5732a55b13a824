// The solids of a body: hulls of two balls, widened across their axis, closed and smooth.
import {
  BufferAttribute,
  BufferGeometry,
  Group,
  Matrix4,
  Mesh,
  MeshStandardMaterial,
  Vector3,
} from 'three';
import type { RoundedCone } from '../bindings/refinement-module';

/** Drawn so much thinner than it is, so that flat triangles of cloth on it do not cut into it [m]. */
const INSET_M = 0.004;

const AROUND = 40;
const ALONG = 10; // rings of each end's ball

/**
 * Points of a cone whose axis runs up from the first ball's centre, widened along x. A normal at the
 * angle `lift` above the cross-section touches the first ball below the slope of the side, the second
 * one above it.
 */
export function coneGeometry(cone: RoundedCone): BufferGeometry {
  const length = new Vector3(...cone.b_m).distanceTo(new Vector3(...cone.a_m));
  const [low, high] = [cone.radius_a_m - INSET_M, cone.radius_b_m - INSET_M];
  const sine = length > 0 ? Math.min(1, Math.max(-1, (low - high) / length)) : 0;
  const slope = Math.asin(sine);
  const rings: { lift: number; radius: number; base: number; width: number }[] = [];
  for (let ring = 0; ring <= ALONG; ++ring) {
    const lift = -Math.PI / 2 + (ring / ALONG) * (slope + Math.PI / 2);
    rings.push({ lift, radius: low, base: 0, width: cone.half_width_a_m });
  }
  for (let ring = 0; ring <= ALONG; ++ring) {
    const lift = slope + (ring / ALONG) * (Math.PI / 2 - slope);
    rings.push({ lift, radius: high, base: length, width: cone.half_width_b_m });
  }
  const positions: number[] = [];
  const normals: number[] = [];
  const indices: number[] = [];
  rings.forEach(({ lift, radius, base, width }, ring) => {
    for (let k = 0; k <= AROUND; ++k) {
      // Half of the points on each side, so that the widened middle is spanned by two straight strips.
      const angle = (2 * Math.PI * k) / AROUND;
      const [x, z] = [Math.cos(angle) * Math.cos(lift), Math.sin(angle) * Math.cos(lift)];
      const side = Math.abs(Math.cos(angle)) < 1e-9 ? 0 : Math.sign(Math.cos(angle));
      positions.push(radius * x + side * width, base + radius * Math.sin(lift), radius * z);
      normals.push(x, Math.sin(lift), z);
      if (k === AROUND || ring === rings.length - 1) continue;
      const a = ring * (AROUND + 1) + k;
      const b = a + AROUND + 1;
      indices.push(a, b, a + 1, a + 1, b, b + 1);
    }
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute('normal', new BufferAttribute(new Float32Array(normals), 3));
  geometry.setIndex(indices);
  return geometry;
}

function shapeOf(cone: RoundedCone): string {
  const length = new Vector3(...cone.b_m).distanceTo(new Vector3(...cone.a_m));
  const numbers = [
    length,
    cone.radius_a_m,
    cone.radius_b_m,
    cone.half_width_a_m,
    cone.half_width_b_m,
  ];
  return numbers.map((number) => number.toFixed(5)).join();
}

export function createBody() {
  const object = new Group();
  const material = new MeshStandardMaterial({ roughness: 0.8 });
  let shapes = '';
  let parts: Mesh[] = [];

  function build(cones: readonly RoundedCone[]): void {
    for (const part of parts) {
      part.geometry.dispose();
      object.remove(part);
    }
    parts = cones.map((cone) => {
      const part = new Mesh(coneGeometry(cone), material);
      part.castShadow = true;
      part.receiveShadow = true;
      part.matrixAutoUpdate = false;
      part.frustumCulled = false;
      object.add(part);
      return part;
    });
  }

  return {
    object,
    /** Moves the solids; builds them anew when their shapes changed. */
    setCones(cones: readonly RoundedCone[]) {
      const wanted = cones.map(shapeOf).join(';');
      if (wanted !== shapes) build(cones);
      shapes = wanted;
      cones.forEach((cone, index) => {
        const from = new Vector3(...cone.a_m);
        const across = new Vector3(...cone.across);
        const up = new Vector3(...cone.b_m).sub(from);
        if (up.lengthSq() === 0) up.set(across.y, -across.x, 0);
        up.normalize();
        const ahead = new Vector3().crossVectors(across, up);
        parts[index]?.matrix.copy(new Matrix4().makeBasis(across, up, ahead)).setPosition(from);
        parts[index]?.updateMatrixWorld(true);
      });
    },
    setColour(colour: string) {
      material.color.set(colour);
    },
  };
}
