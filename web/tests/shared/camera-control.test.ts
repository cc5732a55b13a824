import { PerspectiveCamera, Sphere, Spherical, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { uprightOf } from '../../src/shared/stage/camera-control';

const FOV = 32;

/** How high a place is seen, 1 at the rim, by a camera at that part of the distance of the ball. */
function heightsSeen(places: number[], centre: Vector3, radius: number, upright: number) {
  const half = (FOV * Math.PI) / 360;
  const camera = new PerspectiveCamera(FOV, 1, 0.01, 100);
  camera.position
    .setFromSpherical(new Spherical((upright * radius) / Math.sin(half), 1.08, 0.5))
    .add(centre);
  camera.lookAt(centre);
  camera.updateMatrixWorld();
  const heights: number[] = [];
  for (let k = 0; k < places.length; k += 3)
    heights.push(Math.abs(new Vector3().fromArray(places, k).project(camera).y));
  return heights;
}

describe('uprightOf', () => {
  it.each([
    ['a level sheet', [0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1]],
    ['a level sheet pulled up', [0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 0.5, 0.3, 0.5]],
    ['an upright one', [0, 0, 0, 1, 0, 0, 1, 1.5, 0, 0, 1.5, 0]],
  ])('has %s just inside the picture', (_, places) => {
    const corners = Array.from({ length: places.length / 3 }, (_one, k) =>
      new Vector3().fromArray(places, 3 * k),
    );
    const { center: centre, radius } = new Sphere().setFromPoints(corners);
    const upright = uprightOf(places, { centre, radius, azimuth: 0.5, polar: 1.08 }, FOV);
    const highest = Math.max(...heightsSeen(places, centre, radius, upright));
    expect(highest).toBeLessThan(1);
    expect(highest).toBeGreaterThan(0.85);
  });
});
