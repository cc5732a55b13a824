// Cloth of quads of several sizes: its material, one colour a face, or a number at each vertex by colour;
// with the quads' edges and the vertices that hang.
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  DynamicDrawUsage,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Points,
  PointsMaterial,
} from 'three';
import { frameViews } from '../../shared/bindings/frame';
import type { FabricLook } from '../../shared/fabric/fabric-look';
import { type Colormap, paint } from '../../shared/stage/colormap';
import { createClothMaterials } from '../../shared/stage/fabric-material';
import { showPositions } from '../../shared/stage/normals';
import type { GarmentMesh } from '../worker/garment-protocol';

/** What a cloth is painted with. */
export type Paint =
  | { kind: 'material' }
  /** Linear red, green, blue for each face. */
  | { kind: 'faces'; colours: Float32Array }
  /** The number of each vertex, on a scale from 0. */
  | { kind: 'vertices'; map: Colormap; high: number };

export interface GradedCloth {
  object: Group;
  /** Three numbers a vertex [m]; valid until the next frame. */
  positions(): Float32Array;
  scalars(): Float32Array;
  triangles(): Uint32Array;
  /** The face of a triangle. */
  faceOf(triangle: number): number;
  setMesh(mesh: GarmentMesh): void;
  setFrame(buffer: ArrayBuffer): void;
  /** Takes the last frame to the screen; call before drawing. */
  update(): void;
  setLook(look: FabricLook): void;
  setPaint(paint: Paint): void;
  setEdges(isShown: boolean, colour: string): void;
  setHanging(isShown: boolean, colour: string): void;
  /** Marks the face at that place; null marks none. */
  setChosen(face: number | null): void;
}

/** Of a hanging vertex, in CSS pixels. */
const DOT_SIZE = 5;

export function createGradedCloth(): GradedCloth {
  const geometry = new BufferGeometry();
  const soup = new BufferGeometry(); // each corner by itself, so that faces have colours of their own
  const edgeGeometry = new BufferGeometry();
  const dotGeometry = new BufferGeometry();
  const chosenGeometry = new BufferGeometry();
  const materials = createClothMaterials();
  const faceMaterial = new MeshLambertMaterial({ side: DoubleSide, vertexColors: true });
  // Lines and dots lie on what they belong to.
  for (const material of [materials.front, materials.back, materials.heat, faceMaterial]) {
    material.polygonOffset = true;
    material.polygonOffsetFactor = 1;
    material.polygonOffsetUnits = 1;
  }
  const lineMaterial = new LineBasicMaterial({ transparent: true, opacity: 0.4 });
  const dotMaterial = new PointsMaterial({ size: DOT_SIZE, sizeAttenuation: false });
  const chosenMaterial = new MeshBasicMaterial({
    color: '#ffd400',
    side: DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: -1,
    polygonOffsetUnits: -1,
  });
  const front = new Mesh(geometry, materials.front);
  const back = new Mesh(geometry, materials.back);
  const heat = new Mesh(geometry, materials.heat);
  const faces = new Mesh(soup, faceMaterial);
  const edges = new LineSegments(edgeGeometry, lineMaterial);
  const dots = new Points(dotGeometry, dotMaterial);
  const chosen = new Mesh(chosenGeometry, chosenMaterial);
  for (const mesh of [front, heat, faces]) mesh.castShadow = true;
  for (const mesh of [front, back, faces]) mesh.receiveShadow = true;
  const object = new Group();
  object.add(front, back, heat, faces, edges, dots, chosen);
  for (const part of object.children) part.frustumCulled = false;
  edges.visible = false;
  dots.visible = false;
  chosen.visible = false;

  let triangles = new Uint32Array(0);
  let triangleFaces = new Uint32Array(0);
  let positions: Float32Array = new Float32Array(0);
  let scalars: Float32Array = new Float32Array(0);
  let painted: Paint = { kind: 'material' };
  let isStale = false;

  function dynamic(nNumbers: number): BufferAttribute {
    return new BufferAttribute(new Float32Array(nNumbers), 3).setUsage(DynamicDrawUsage);
  }

  function attribute(of: BufferGeometry, name: string): BufferAttribute {
    return of.getAttribute(name) as BufferAttribute;
  }

  /** Copies what the vertices have to the corners. */
  function spread(name: 'position' | 'normal'): void {
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

  function paintFaces(colours: Float32Array): void {
    const to = attribute(soup, 'color');
    const into = to.array as Float32Array;
    for (let corner = 0; corner < triangles.length; ++corner) {
      const face = triangleFaces[Math.floor(corner / 3)] as number;
      into.set(colours.subarray(3 * face, 3 * face + 3), 3 * corner);
    }
    to.needsUpdate = true;
  }

  function show(): void {
    front.visible = painted.kind === 'material';
    back.visible = painted.kind === 'material';
    heat.visible = painted.kind === 'vertices';
    faces.visible = painted.kind === 'faces';
    isStale = true;
  }
  show();

  return {
    object,
    positions: () => positions,
    scalars: () => scalars,
    triangles: () => triangles,
    faceOf: (triangle) => triangleFaces[triangle] ?? 0,
    setMesh(mesh) {
      triangles = new Uint32Array(mesh.triangles);
      triangleFaces = new Uint32Array(mesh.triangleFaces);
      positions = new Float32Array(0);
      const nVertices = mesh.parents.length / 4;
      for (const part of [geometry, soup, edgeGeometry, dotGeometry, chosenGeometry])
        part.dispose();
      for (const name of ['position', 'normal', 'color']) {
        geometry.setAttribute(name, dynamic(3 * nVertices));
        soup.setAttribute(name, dynamic(3 * triangles.length));
      }
      geometry.setIndex(new BufferAttribute(triangles, 1));
      for (const [part, index] of [
        [edgeGeometry, mesh.edges],
        [dotGeometry, mesh.hanging],
        [chosenGeometry, new Uint32Array(0)],
      ] as const) {
        part.setAttribute('position', geometry.getAttribute('position'));
        part.setIndex(new BufferAttribute(index, 1));
      }
      chosen.visible = false;
      painted = { kind: 'material' };
      show();
    },
    setFrame(buffer) {
      const views = frameViews(buffer);
      positions = views.positions;
      scalars = views.scalar;
      isStale = true;
    },
    update() {
      if (!isStale || positions.length === 0) return;
      isStale = false;
      showPositions(geometry, positions, triangles);
      if (painted.kind === 'faces') {
        spread('position');
        spread('normal');
      } else if (painted.kind === 'vertices') {
        const colours = attribute(geometry, 'color');
        paint(painted.map, scalars, 0, painted.high, colours.array as Float32Array);
        colours.needsUpdate = true;
      }
    },
    setLook: materials.setLook,
    setPaint(newPaint) {
      painted = newPaint;
      if (painted.kind === 'faces') paintFaces(painted.colours);
      show();
    },
    setEdges(isShown, colour) {
      edges.visible = isShown;
      lineMaterial.color.set(colour);
    },
    setHanging(isShown, colour) {
      dots.visible = isShown;
      dotMaterial.color.set(colour);
    },
    setChosen(face) {
      chosen.visible = face !== null;
      if (face === null) return;
      const own = triangles.filter((_, corner) => triangleFaces[Math.floor(corner / 3)] === face);
      chosenGeometry.setIndex(new BufferAttribute(own, 1));
    },
  };
}
