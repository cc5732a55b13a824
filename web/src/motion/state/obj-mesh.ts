// A mesh from an OBJ file: how its threads run, what holds it, and the world around it.

import type { Triple } from '../../shared/bindings/geometry';
import type { ObjAnswer } from '../../shared/bindings/pleat-module';
import type { StartShape } from '../../shared/page/view';
import type { ObjUnit } from '../../shared/state/obj-file';
import { boxOf, minus } from '../../shared/state/vectors';

/** "highest", "nothing", or "group:" and the name of a group of the mesh. */
export type Hold = 'highest' | 'nothing' | `group:${string}`;

/** The source of the threads' directions: texture coordinates, or a direction for want of them. */
export type Threads = 'texture' | 'down' | 'along_x';

export interface ObjMesh {
  /** Name of the file, or words on what it is. */
  name: string;
  /** Brought by the visitor; else it is the page's example. */
  isOwn: boolean;
  /** Unit of the file; everything here is in metres. */
  unit: ObjUnit;
  /** Words on what is odd about its size. */
  odd: string | null;
  /** Skipped statements of the file, in words. */
  skipped?: string;
  /** The section "cloth" of a scene. */
  clothText: string;
  groups: string[];
  nVertices: number;
  nTriangles: number;
  low: Triple;
  high: Triple;
  threads: Threads;
  /** Places where its vertices start, unless they start where they rest, three numbers each [m]. */
  start?: Float64Array;
}

export const DIRECTIONS: Record<Exclude<Threads, 'texture'>, Triple> = {
  down: [0, -1, 0],
  along_x: [1, 0, 0],
};

/** A mesh lower than this part of its length lies flat. */
const FLAT_HEIGHT = 0.02;
/** The highest points: within this part of the height. */
const HIGHEST_PART = 0.02;
/** The floor lies this part of the mesh's diagonal below it. */
const FLOOR_BELOW = 0.1;

type Box = Pick<ObjMesh, 'low' | 'high'>;

export function liesFlat(box: Box): boolean {
  const [width, height, depth] = minus(box.high, box.low);
  return height < FLAT_HEIGHT * Math.max(width, depth);
}

export function objMesh(
  file: Pick<ObjMesh, 'name' | 'isOwn' | 'unit' | 'odd' | 'threads'>,
  answer: ObjAnswer,
): ObjMesh {
  return {
    ...file,
    skipped: answer.skipped,
    clothText: JSON.stringify(answer.cloth),
    groups: answer.groups,
    nVertices: answer.n_vertices,
    nTriangles: answer.n_triangles,
    low: answer.low_m,
    high: answer.high_m,
  };
}

/** The holds that a mesh may have. The highest points of a flat one would be all. */
export function holdsOf(mesh: ObjMesh): Hold[] {
  const groups = mesh.groups.map((name): Hold => `group:${name}`);
  return liesFlat(mesh) ? [...groups, 'nothing'] : ['highest', ...groups, 'nothing'];
}

/** The wanted hold where this mesh knows it, else the first one that it has to itself. */
export function holdFor(mesh: ObjMesh, wanted: Hold): Hold {
  if (holdsOf(mesh).includes(wanted)) return wanted;
  return liesFlat(mesh) ? 'nothing' : 'highest';
}

function pinsOf(mesh: ObjMesh, wanted: Hold): object[] {
  const hold = holdFor(mesh, wanted);
  if (hold === 'nothing') return [];
  if (hold !== 'highest') return [{ part: hold.slice('group:'.length) }];
  const [x, y, z] = mesh.low;
  const top = mesh.high[1];
  return [{ box: { low_m: [x, top - HIGHEST_PART * (top - y), z], high_m: mesh.high } }];
}

/** Cloth, pins and solids of a scene: the mesh above a floor. */
export function objScene(mesh: ObjMesh, hold: Hold) {
  const floor = mesh.low[1] - FLOOR_BELOW * Math.hypot(...minus(mesh.high, mesh.low));
  return {
    cloth: JSON.parse(mesh.clothText) as object,
    pins: pinsOf(mesh, hold),
    colliders: [{ plane: { point_m: [0, floor, 0], normal: [0, 1, 0] } }],
  };
}

/** A cloth that starts from a shape between rest and what it was pulled into; what held it is its group "held". */
export function deformedMesh({ name, section, positions: start }: StartShape): ObjMesh {
  const { mesh } = section as {
    mesh: { positions_m: Triple[]; triangles: unknown[]; groups?: object };
  };
  return {
    name,
    isOwn: true,
    unit: 'm',
    odd: null,
    clothText: JSON.stringify(section),
    groups: Object.keys(mesh.groups ?? {}),
    nVertices: start.length / 3,
    nTriangles: mesh.triangles.length,
    ...boxOf(start),
    threads: 'texture',
    start,
  };
}
