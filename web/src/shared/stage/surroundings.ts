// Floor, metre grid, light, and the bodies the cloth falls on.
import {
  BufferAttribute,
  BufferGeometry,
  CircleGeometry,
  DirectionalLight,
  Group,
  HemisphereLight,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  ShadowMaterial,
  Vector3,
} from 'three';
import type { Collider } from '../bindings/geometry';
import { bodiesOf, type SolidBody } from './solid-look';

/** Half the side of the grid, and its line spacing: metres, or a power of ten of them [m]. */
const GRID_REACH_M = 4;
const GRID_SPACING_M = 0.5;
const LINE_PIECES = 16;

/** How far along its normal a surface looks for its shadow, in a scene of a metre [m]. */
const NORMAL_BIAS = 0.012;

/** Alpha that fades to nothing at the edge of the floor, with distance from its middle [m]. */
function fade(distance: number): number {
  const part = Math.min(1, distance / GRID_REACH_M);
  return (1 - part * part) ** 2;
}

/** Lines every half metre in the floor's own plane, cut into pieces so that they can fade. */
function gridGeometry(): BufferGeometry {
  const positions: number[] = [];
  const colours: number[] = [];
  const add = (x: number, z: number, isMetre: boolean) => {
    positions.push(x, 0, z);
    colours.push(1, 1, 1, fade(Math.hypot(x, z)) * (isMetre ? 1 : 0.45));
  };
  const nLines = GRID_REACH_M / GRID_SPACING_M;
  for (let line = -nLines; line <= nLines; ++line) {
    const offset = line * GRID_SPACING_M;
    const isMetre = Number.isInteger(offset);
    for (let piece = -LINE_PIECES; piece < LINE_PIECES; ++piece) {
      const from = (piece / LINE_PIECES) * GRID_REACH_M;
      const to = ((piece + 1) / LINE_PIECES) * GRID_REACH_M;
      add(offset, from, isMetre);
      add(offset, to, isMetre);
      add(from, offset, isMetre);
      add(to, offset, isMetre);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute('color', new BufferAttribute(new Float32Array(colours), 4));
  return geometry;
}

/** A disc whose rim is transparent. */
function discGeometry(): BufferGeometry {
  const nRings = 24;
  const nSectors = 64;
  const positions: number[] = [];
  const colours: number[] = [];
  const indices: number[] = [];
  for (let ring = 0; ring <= nRings; ++ring) {
    const radius = (ring / nRings) * GRID_REACH_M;
    for (let sector = 0; sector <= nSectors; ++sector) {
      const angle = (2 * Math.PI * sector) / nSectors;
      positions.push(radius * Math.cos(angle), 0, radius * Math.sin(angle));
      colours.push(1, 1, 1, fade(radius));
      if (ring === nRings || sector === nSectors) continue;
      const a = ring * (nSectors + 1) + sector;
      const b = a + nSectors + 1;
      indices.push(a, a + 1, b, a + 1, b + 1, b);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute('color', new BufferAttribute(new Float32Array(colours), 4));
  geometry.setIndex(indices);
  return geometry;
}

/** A disc, a grid on it and the shadows that fall there, in one plane. */
function createFloor() {
  const object = new Group();
  const see = { transparent: true, vertexColors: true, depthWrite: false, toneMapped: false };
  const disc = new Mesh(discGeometry(), new MeshBasicMaterial(see));
  const grid = new LineSegments(gridGeometry(), new LineBasicMaterial(see));
  const shadow = new Mesh(
    new CircleGeometry(GRID_REACH_M, 64),
    new ShadowMaterial({ opacity: 0.3 }),
  );
  shadow.rotation.x = -Math.PI / 2;
  shadow.receiveShadow = true;
  // Drawn in this order and without depth, three things in one plane do not flicker.
  [disc, grid, shadow].forEach((part, order) => {
    part.renderOrder = order - 3;
    object.add(part);
  });
  return { object, disc, grid };
}

/** The light that casts shadows, and how it stands to a lit sphere. */
function createKeyLight() {
  const light = new DirectionalLight('#fff4e2', 2.5);
  light.castShadow = true;
  light.shadow.mapSize.set(1024, 1024);
  light.shadow.radius = 4;
  light.shadow.bias = -0.0004;
  return {
    light,
    place({ x, y, z }: Vector3, radius: number) {
      light.position.set(x + 1.2 * radius, y + 3 * radius, z + 1.6 * radius);
      light.target.position.set(x, y, z);
    },
    frame(radius: number, scale: number) {
      light.shadow.normalBias = NORMAL_BIAS * Math.max(scale, Math.min(1, radius));
      const { camera } = light.shadow;
      camera.left = -1.6 * radius;
      camera.right = 1.6 * radius;
      camera.top = 1.6 * radius;
      camera.bottom = -1.6 * radius;
      camera.near = 0.1 * radius;
      camera.far = 8 * radius;
      camera.updateProjectionMatrix();
    },
  };
}

/** The bodies among the solids. */
function createBodies() {
  const object = new Group();
  const material = new MeshStandardMaterial({ roughness: 0.75 });
  let meshes: Mesh[] = [];
  let forms = '';

  function build(body: SolidBody): Mesh {
    const mesh = new Mesh(body.build(), material);
    mesh.castShadow = true;
    mesh.receiveShadow = true;
    return mesh;
  }

  return {
    object,
    material,
    set(colliders: Collider[]) {
      const bodies = bodiesOf(colliders);
      const wanted = bodies.map(({ form }) => form).join();
      if (wanted !== forms) {
        forms = wanted;
        for (const mesh of meshes) mesh.geometry.dispose();
        meshes = bodies.map(build);
        object.clear();
        if (meshes.length > 0) object.add(...meshes);
      }
      bodies.forEach(({ centre }, index) => {
        meshes[index]?.position.set(...centre);
      });
    },
  };
}

export function createSurroundings() {
  const object = new Group();
  const floor = createFloor();
  const bodies = createBodies();
  const key = createKeyLight();
  const sky = new HemisphereLight('#ffffff', '#a79f92', 1.35);
  object.add(floor.object, sky, key.light, key.light.target, bodies.object);
  let lit = { centre: new Vector3(), radius: 1 };

  return {
    object,
    /** Moves the bodies; builds them anew when their number or form changed. */
    setColliders: bodies.set,
    /** Puts the floor at `height` [m] and the lights so that a sphere is lit and shadowed well. */
    frame(centre: Vector3, radius: number, height: number) {
      const scale = 10 ** Math.round(Math.log10(radius));
      floor.object.scale.setScalar(scale);
      floor.object.position.set(centre.x, height, centre.z);
      lit = { centre: centre.clone(), radius };
      key.place(centre, radius);
      key.frame(radius, scale);
    },
    /** Puts floor and lights under somebody who walks; the grid's lines stay where they are [m]. */
    follow(x: number, z: number) {
      lit.centre.set(x, lit.centre.y, z);
      key.place(lit.centre, lit.radius);
      floor.object.position.x = x;
      floor.object.position.z = z;
      const metre = floor.object.scale.x;
      const into = (place: number) => (Math.round(place / metre) * metre - place) / metre;
      floor.grid.position.set(into(x), 0, into(z));
    },
    /** Shadows cost as much as the picture itself, each time. */
    setShadows(areCast: boolean) {
      key.light.castShadow = areCast;
    },
    /** `colour` reads a variable of the page's design. */
    setTheme(colour: (name: string) => string) {
      floor.disc.material.color.set(colour('--stage-floor'));
      floor.grid.material.color.set(colour('--stage-grid'));
      bodies.material.color.set(colour('--stage-body'));
    },
  };
}
