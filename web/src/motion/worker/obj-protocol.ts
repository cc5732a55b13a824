// Messages between the page and the worker that reads a mesh, both ways.

import type { Triple } from '../../shared/bindings/geometry';
import type { Refusal } from '../../shared/bindings/refusals';
import type { ObjMesh } from '../state/obj-mesh';

/** Reads to its end; to cancel, terminate the worker. */
export interface ToObj {
  type: 'readObj';
  fabricsText: string;
  /** Vertices in metres. */
  objText: string;
  /** The file as far as it is known; its ends in any unit. */
  file: Pick<ObjMesh, 'name' | 'isOwn' | 'unit' | 'odd'> & { low: Triple; high: Triple };
}

export interface ObjReadMessage {
  type: 'objRead';
  mesh: ObjMesh;
}

export type FromObj = ObjReadMessage | Refusal;
