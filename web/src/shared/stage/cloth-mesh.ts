// One mesh from one frame: positions as they come, smooth normals, material or heat map.
import {
  BufferAttribute,
  BufferGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
} from 'three';
import { frameViews, type Scalar } from '../bindings/frame';
import { MAGNITUDE_MAP, paint, roundedUp, SIGNED_MAP } from './colormap';
import { createClothMaterials, type Print } from './fabric-material';
import type { HeatMap, HeatScale } from './heat-map';
import { changingTriples, showPositions } from './normals';

/** A still cloth has no stretch: the scale then ends at 0.01 %, or at 0.1 mm, not at nothing. */
const LEAST_REACH = 1e-4;

/** Each edge once, as pairs of vertices. */
function edgesOf(triangles: Uint32Array): Uint32Array {
  const seen = new Set<number>();
  const edges: number[] = [];
  let nVertices = 0;
  for (const vertex of triangles) nVertices = Math.max(nVertices, vertex + 1);
  for (let corner = 0; corner < triangles.length; ++corner) {
    const a = triangles[corner] ?? 0;
    const b = triangles[corner % 3 === 2 ? corner - 2 : corner + 1] ?? 0;
    const key = Math.min(a, b) * nVertices + Math.max(a, b);
    if (seen.has(key)) continue;
    seen.add(key);
    edges.push(a, b);
  }
  return Uint32Array.from(edges);
}

/** The drawn meshes: both sides of the cloth, the heat map in their place, and the edges. */
function createParts(geometry: BufferGeometry, edgeGeometry: BufferGeometry) {
  const materials = createClothMaterials();
  const front = new Mesh(geometry, materials.front);
  const back = new Mesh(geometry, materials.back);
  const heat = new Mesh(geometry, materials.heat);
  const edges = new LineSegments(
    edgeGeometry,
    new LineBasicMaterial({ color: '#101418', transparent: true, opacity: 0.45 }),
  );
  front.castShadow = true;
  for (const mesh of [front, back]) mesh.receiveShadow = true;
  heat.castShadow = true;
  heat.visible = false;
  edges.visible = false;
  const object = new Group();
  object.add(front, back, heat, edges);
  for (const part of object.children) part.frustumCulled = false;
  const { setLook, setTexture } = materials;
  return { object, front, back, heat, edges, setLook, setTexture };
}

const NO_SCALE: HeatScale = { map: 'off', low: 0, high: 0, least: 0, most: 0 };

/** Colours vertices by what a frame holds of them, and tells the scale. */
class HeatPaint {
  map: HeatMap = 'off';
  /** Upper end for stretch [%]. */
  range: 'auto' | number = 'auto';
  scale = NO_SCALE;
  private painted = new Float32Array(0);

  resize(nVertices: number): void {
    this.painted = new Float32Array(nVertices);
  }

  paint(values: Float32Array, scalar: Scalar, colours: BufferAttribute): void {
    const { map, painted } = this;
    this.scale = NO_SCALE;
    if (map === 'off') return;
    const isWanted = (map === 'distance') === (scalar === 'distance');
    for (let v = 0; v < values.length; ++v) {
      const value = isWanted ? (values[v] as number) : Number.NaN;
      painted[v] = map === 'signed' ? value : Math.abs(value);
    }
    let least = Number.POSITIVE_INFINITY;
    let most = Number.NEGATIVE_INFINITY;
    for (const value of painted) {
      least = Math.min(least, value);
      most = Math.max(most, value);
    }
    const reach = Math.max(Math.abs(least), Math.abs(most), LEAST_REACH);
    const range = map === 'distance' ? 'auto' : this.range;
    const high = range === 'auto' ? roundedUp(reach) : range / 100;
    const low = map === 'signed' ? -high : 0;
    this.scale = { map, low, high, least, most };
    const table = map === 'signed' ? SIGNED_MAP : MAGNITUDE_MAP;
    paint(table, painted, low, high, colours.array as Float32Array);
    colours.needsUpdate = true;
  }
}

export function createClothMesh() {
  const geometry = new BufferGeometry();
  const edgeGeometry = new BufferGeometry();
  const parts = createParts(geometry, edgeGeometry);
  const { object, front, back, heat, edges, setLook, setTexture } = parts;
  const heatPaint = new HeatPaint();
  let triangles = new Uint32Array(0);
  let positions: Float32Array = new Float32Array(0);
  let values: Float32Array = new Float32Array(0);
  let scalar: Scalar = 'stretch';
  let isStale = false; // the frame or the heat map changed since the last update
  let print: Print | null = null;

  function showPrint(): void {
    const nVertices = geometry.getAttribute('position')?.count ?? 0;
    const fitting = print?.coordinates.length === 2 * nVertices ? print : null;
    if (fitting) geometry.setAttribute('uv', new BufferAttribute(fitting.coordinates, 2));
    else geometry.deleteAttribute('uv');
    setTexture(fitting?.texture ?? null);
  }

  return {
    object,
    /** Present positions, three numbers a vertex [m]; valid until the next frame. */
    positions: () => positions,
    triangles: () => triangles,
    heatScale: () => heatPaint.scale,
    setTopology(newTriangles: Uint32Array, nVertices: number) {
      triangles = new Uint32Array(newTriangles);
      heatPaint.resize(nVertices);
      geometry.dispose();
      edgeGeometry.dispose();
      for (const name of ['position', 'normal', 'color'])
        geometry.setAttribute(name, changingTriples(nVertices));
      geometry.setIndex(new BufferAttribute(triangles, 1));
      edgeGeometry.setAttribute('position', geometry.getAttribute('position'));
      edgeGeometry.setIndex(new BufferAttribute(edgesOf(triangles), 1));
      showPrint();
    },
    setFrame(buffer: ArrayBuffer, newScalar: Scalar) {
      const views = frameViews(buffer);
      positions = views.positions;
      values = views.scalar;
      scalar = newScalar;
      isStale = true;
    },
    /** Takes the last frame to the screen; call before drawing. */
    update() {
      if (!isStale || positions.length === 0) return;
      isStale = false;
      showPositions(geometry, positions, triangles);
      heatPaint.paint(values, scalar, geometry.getAttribute('color') as BufferAttribute);
    },
    setLook,
    /** Shown while the mesh has as many vertices as the print. */
    setPrint(newPrint: Print | null) {
      if (print !== newPrint) print?.texture.dispose();
      print = newPrint;
      showPrint();
    },
    /** `range` is of stretch [%]. True when that is another map or range. */
    setHeat(map: HeatMap, range: 'auto' | number) {
      if (map === heatPaint.map && range === heatPaint.range) return false;
      heatPaint.map = map;
      heatPaint.range = range;
      front.visible = map === 'off';
      back.visible = map === 'off';
      heat.visible = map !== 'off';
      isStale = true;
      return true;
    },
    setEdges(isShown: boolean) {
      edges.visible = isShown;
    },
    /** Gives back what the graphics card holds. */
    close() {
      geometry.dispose();
      edgeGeometry.dispose();
      print?.texture.dispose();
      for (const { material } of [front, back, heat, edges]) material.dispose();
    },
  };
}

export type ClothMesh = ReturnType<typeof createClothMesh>;
