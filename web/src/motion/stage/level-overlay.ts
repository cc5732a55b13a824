// A coarser level over the cloth: its edges as lines, a large mark on each vertex that it keeps, and a
// small one on each that it leaves out of the level before.
import {
  BufferAttribute,
  BufferGeometry,
  DataTexture,
  DynamicDrawUsage,
  Group,
  LineBasicMaterial,
  LineSegments,
  Points,
  PointsMaterial,
} from 'three';
import type { MeshLevel } from '../../shared/bindings/pleat-module';
import type { Overlay } from '../../shared/stage/overlay';
import { extentOf } from '../../shared/state/vectors';

/** Lines and marks are drawn that much nearer to the eye, so that no cloth that they lie on hides them. */
const NEARER = 0.01;
/** Opacity of what is behind the cloth and shows through it, faintly: edges of a level cut folds short. */
const BEHIND = 0.3;
/** Width of a mark on a vertex that is kept: a share of the way between these, and of the cloth at most. */
const KEPT_OF_SPACING = 0.35;
const KEPT_OF_CLOTH = 0.024;
/** Others are that much smaller. */
const LEFT_OUT_OF_KEPT = 0.55;
/** A stage sees 32 degrees. */
const VIEW_FACTOR = 1 / Math.tan((16 * Math.PI) / 180);
/** Width of the drawing of a mark [px], and of its rim. */
const DISC_PX = 32;
const RIM_PX = 5;

/** Vertices that a level leaves out of the one before, which is the mesh where there is none. */
export function leftOut(
  { vertices }: MeshLevel,
  before: MeshLevel | undefined,
  nVertices: number,
): Uint32Array {
  const kept = new Set(vertices);
  const all = before?.vertices ?? Uint32Array.from({ length: nVertices }, (_, v) => v);
  return all.filter((vertex) => !kept.has(vertex));
}

/** A white disc with a dark rim, which is seen on cloth of any colour. */
function discTexture(): DataTexture {
  const data = new Uint8Array(4 * DISC_PX * DISC_PX);
  const middle = (DISC_PX - 1) / 2;
  for (let pixel = 0; pixel < DISC_PX * DISC_PX; ++pixel) {
    const [x, y] = [pixel % DISC_PX, Math.floor(pixel / DISC_PX)];
    const inside = DISC_PX / 2 - Math.hypot(x - middle, y - middle);
    const light = inside < RIM_PX ? 0 : 255;
    data.set([light, light, light, inside > 0 ? 255 : 0], 4 * pixel);
  }
  const texture = new DataTexture(data, DISC_PX, DISC_PX);
  texture.needsUpdate = true;
  return texture;
}

/** Width of a mark on a vertex that is kept [m]. */
function markSize(positions: Float32Array, nKept: number): number {
  const diagonal = extentOf(positions);
  const spacing = diagonal / Math.sqrt(2 * nKept);
  return Math.min(KEPT_OF_SPACING * spacing, KEPT_OF_CLOTH * diagonal);
}

function createMarks(map: DataTexture) {
  const material = new PointsMaterial({ map, alphaTest: 0.5 });
  material.toneMapped = false;
  return new Points(new BufferGeometry(), material);
}

function createEdges(depthTest: boolean, opacity: number) {
  const material = new LineBasicMaterial({ depthTest, opacity, transparent: opacity < 1 });
  material.toneMapped = false;
  return new LineSegments(new BufferGeometry(), material);
}

export interface LevelOverlay extends Overlay {
  /** A level and the one before it, which is the mesh where there is none; null draws nothing. */
  show(level: MeshLevel | null, before: MeshLevel | undefined, nVertices: number): void;
}

export function createLevelOverlay(): LevelOverlay {
  const disc = discTexture();
  const faint = createEdges(false, BEHIND);
  const edges = createEdges(true, 1);
  const kept = createMarks(disc);
  const out = createMarks(disc);
  const parts = [faint, edges, out, kept];
  const object = new Group();
  object.add(...parts);
  object.visible = false;
  for (const part of parts) part.frustumCulled = false;
  let places = new BufferAttribute(new Float32Array(0), 3);
  let isSized = false; // the marks, for the level that is shown
  let nKept = 0;
  return {
    object,
    show(level, before, nVertices) {
      object.visible = level !== null;
      if (!level) return;
      isSized = false;
      nKept = level.vertices.length;
      for (const { geometry } of [faint, edges])
        geometry.setIndex(new BufferAttribute(level.edges, 1));
      kept.geometry.setIndex(new BufferAttribute(level.vertices, 1));
      out.geometry.setIndex(new BufferAttribute(leftOut(level, before, nVertices), 1));
    },
    clear() {
      object.visible = false;
    },
    update(positions, eye) {
      if (!object.visible) return;
      if (places.array.length !== positions.length) {
        places = new BufferAttribute(positions.slice(), 3).setUsage(DynamicDrawUsage);
        for (const { geometry } of parts) {
          geometry.dispose();
          geometry.setAttribute('position', places);
        }
      }
      if (!isSized) {
        isSized = true;
        // Sizes that shrink with distance are of a view of 90 degrees.
        kept.material.size = markSize(positions, nKept) * VIEW_FACTOR;
        out.material.size = LEFT_OUT_OF_KEPT * kept.material.size;
      }
      places.array.set(positions);
      places.needsUpdate = true;
      object.scale.setScalar(1 - NEARER);
      object.position.copy(eye).multiplyScalar(NEARER);
    },
    themed(colour) {
      for (const { material } of [faint, edges, kept]) material.color.set(colour('--level-kept'));
      out.material.color.set(colour('--level-out'));
    },
  };
}
