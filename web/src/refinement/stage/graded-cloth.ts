// Cloth of quads of several sizes: its material, one colour a face, or a number at each vertex by colour;
// with the quads' edges and the vertices that hang.
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Points,
  PointsMaterial,
} from 'three';
import { frameViews } from '../../shared/bindings/frame';
import { type Colormap, paint } from '../../shared/stage/colormap';
import { createClothMaterials } from '../../shared/stage/fabric-material';
import { changingTriples, showPositions } from '../../shared/stage/normals';
import type { GarmentMesh } from '../worker/garment-protocol';

/** The paint of a cloth: its material, or colours of faces or vertices. */
export type Paint =
  | { kind: 'material' }
  /** Linear red, green, blue for each face. */
  | { kind: 'faces'; colours: Float32Array }
  /** The number of each vertex, on a scale from 0. */
  | { kind: 'vertices'; map: Colormap; high: number };

/** Size of the dot at a hanging vertex [CSS pixels]. */
const DOT_SIZE = 5;

/** Lines and dots lie on the cloth that they belong to. */
function behindLines(materials: Material[]): void {
  for (const material of materials) {
    material.polygonOffset = true;
    material.polygonOffsetFactor = 1;
    material.polygonOffsetUnits = 1;
  }
}

/** The drawn objects and their geometries. */
function createParts() {
  const geometry = new BufferGeometry();
  const soup = new BufferGeometry(); // each corner by itself, so that faces have colours of their own
  const edgeGeometry = new BufferGeometry();
  const dotGeometry = new BufferGeometry();
  const chosenGeometry = new BufferGeometry();
  const materials = createClothMaterials();
  const faceMaterial = new MeshLambertMaterial({ side: DoubleSide, vertexColors: true });
  behindLines([materials.front, materials.back, materials.heat, faceMaterial]);
  const chosenMaterial = new MeshBasicMaterial({
    color: '#ffd400',
    side: DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: -1,
    polygonOffsetUnits: -1,
  });
  const lineMaterial = new LineBasicMaterial({ transparent: true, opacity: 0.4 });
  const dotMaterial = new PointsMaterial({ size: DOT_SIZE, sizeAttenuation: false });
  const front = new Mesh(geometry, materials.front);
  const back = new Mesh(geometry, materials.back);
  const heat = new Mesh(geometry, materials.heat);
  const faces = new Mesh(soup, faceMaterial);
  const edges = new LineSegments(edgeGeometry, lineMaterial);
  const dots = new Points(dotGeometry, dotMaterial);
  const chosen = new Mesh(chosenGeometry, chosenMaterial);
  for (const mesh of [front, heat, faces]) mesh.castShadow = true;
  for (const mesh of [front, back, faces]) mesh.receiveShadow = true;
  for (const part of [edges, dots, chosen]) part.visible = false;
  const object = new Group();
  object.add(front, back, heat, faces, edges, dots, chosen);
  for (const part of object.children) part.frustumCulled = false;
  return { object, front, back, heat, faces, edges, dots, chosen, setLook: materials.setLook };
}

function attribute(of: BufferGeometry, name: string): BufferAttribute {
  return of.getAttribute(name) as BufferAttribute;
}

/** Copies what the vertices have to the corners. */
function spread(
  name: 'position' | 'normal',
  geometry: BufferGeometry,
  soup: BufferGeometry,
  triangles: Uint32Array,
): void {
  const from = attribute(geometry, name).array as Float32Array;
  const to = attribute(soup, name);
  const into = to.array as Float32Array;
  for (let corner = 0; corner < triangles.length; ++corner) {
    const at = 3 * (triangles[corner] as number);
    into[3 * corner] = from[at] as number;
    into[3 * corner + 1] = from[at + 1] as number;
    into[3 * corner + 2] = from[at + 2] as number;
  }
  to.needsUpdate = true;
}

/** Gives the corners of each face the face's colour. */
function paintFaces(colours: Float32Array, soup: BufferGeometry, triangleFaces: Uint32Array): void {
  const to = attribute(soup, 'color');
  const into = to.array as Float32Array;
  for (let corner = 0; 3 * corner < into.length; ++corner) {
    const face = triangleFaces[Math.floor(corner / 3)] as number;
    into.set(colours.subarray(3 * face, 3 * face + 3), 3 * corner);
  }
  to.needsUpdate = true;
}

/** Gives the geometries of the parts room for another mesh. */
function setTopology(
  { front, faces, edges, dots, chosen }: ReturnType<typeof createParts>,
  mesh: GarmentMesh,
  triangles: Uint32Array,
): void {
  const { geometry } = front;
  for (const part of [front, faces, edges, dots, chosen]) part.geometry.dispose();
  for (const name of ['position', 'normal', 'color']) {
    geometry.setAttribute(name, changingTriples(mesh.parents.length / 4));
    faces.geometry.setAttribute(name, changingTriples(triangles.length));
  }
  geometry.setIndex(new BufferAttribute(triangles, 1));
  for (const [part, index] of [
    [edges, mesh.edges],
    [dots, mesh.hanging],
    [chosen, new Uint32Array(0)],
  ] as const) {
    part.geometry.setAttribute('position', geometry.getAttribute('position'));
    part.geometry.setIndex(new BufferAttribute(index, 1));
  }
}

export function createGradedCloth() {
  const parts = createParts();
  const { object, front, back, heat, faces, edges, dots, chosen, setLook } = parts;
  let triangles = new Uint32Array(0);
  let triangleFaces = new Uint32Array(0);
  let positions: Float32Array = new Float32Array(0);
  let scalars: Float32Array = new Float32Array(0);
  let painted: Paint = { kind: 'material' };
  let isStale = false;

  function setPaint(paint: Paint): void {
    painted = paint;
    if (paint.kind === 'faces') paintFaces(paint.colours, faces.geometry, triangleFaces);
    front.visible = paint.kind === 'material';
    back.visible = paint.kind === 'material';
    heat.visible = paint.kind === 'vertices';
    faces.visible = paint.kind === 'faces';
    isStale = true;
  }
  setPaint(painted);

  return {
    object,
    /** Three numbers a vertex [m]; valid until the next frame. */
    positions: () => positions,
    scalars: () => scalars,
    triangles: () => triangles,
    /** The face of a triangle. */
    faceOf: (triangle: number) => triangleFaces[triangle] ?? 0,
    setMesh(mesh: GarmentMesh) {
      triangles = new Uint32Array(mesh.triangles);
      triangleFaces = new Uint32Array(mesh.triangleFaces);
      positions = new Float32Array(0);
      setTopology(parts, mesh, triangles);
      chosen.visible = false;
      setPaint({ kind: 'material' });
    },
    setFrame(buffer: ArrayBuffer) {
      const views = frameViews(buffer);
      positions = views.positions;
      scalars = views.scalar;
      isStale = true;
    },
    /** Takes the last frame to the screen; call before drawing. */
    update() {
      if (!isStale || positions.length === 0) return;
      isStale = false;
      const { geometry } = front;
      showPositions(geometry, positions, triangles);
      if (painted.kind === 'faces') {
        spread('position', geometry, faces.geometry, triangles);
        spread('normal', geometry, faces.geometry, triangles);
      } else if (painted.kind === 'vertices') {
        const colours = attribute(geometry, 'color');
        paint(painted.map, scalars, 0, painted.high, colours.array as Float32Array);
        colours.needsUpdate = true;
      }
    },
    setLook,
    setPaint,
    setEdges(isShown: boolean, colour: string) {
      edges.visible = isShown;
      edges.material.color.set(colour);
    },
    setHanging(isShown: boolean, colour: string) {
      dots.visible = isShown;
      dots.material.color.set(colour);
    },
    /** Marks the face at that place; null marks none. */
    setChosen(face: number | null) {
      chosen.visible = face !== null;
      if (face === null) return;
      const own = triangles.filter((_, corner) => triangleFaces[Math.floor(corner / 3)] === face);
      chosen.geometry.setIndex(new BufferAttribute(own, 1));
    },
  };
}

export type GradedCloth = ReturnType<typeof createGradedCloth>;
