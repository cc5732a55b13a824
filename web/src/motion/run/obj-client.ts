// Starts the worker that reads one mesh.
import type { Asked, Listener } from '../../shared/workers/asked';
import { startAsked } from '../../shared/workers/compiled-core';
import type { ObjReadMessage, ToObj } from '../worker/obj-protocol';

export type ObjClient = Asked<ToObj, { readObj: ObjReadMessage }>;
export type StartObj = (listener: Listener<never>) => ObjClient;

export function startObjWorker(listener: Listener<never>): ObjClient {
  return startAsked(
    new Worker(new URL('../worker/obj-worker.ts', import.meta.url), { type: 'module' }),
    listener,
  );
}
