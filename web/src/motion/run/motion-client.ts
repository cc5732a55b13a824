// Starts the workers that show cloth in motion.
import { type Asked, createAsked, type Listener } from '../../shared/workers/asked';
import { withCore } from '../../shared/workers/compiled-core';
import type { FromMotion, MotionAnswers, ToMotion } from '../../shared/workers/motion-protocol';
import type { ObjReadMessage, ToObj } from '../worker/obj-protocol';

export type MotionClient = Asked<ToMotion, MotionAnswers>;
export type StartMotion = (listener: Listener<FromMotion>) => MotionClient;

/** Runs the shown cloth. */
export function startMotionWorker(listener: Listener<FromMotion>): MotionClient {
  return createAsked(
    withCore(
      new Worker(new URL('../worker/motion-worker.ts', import.meta.url), { type: 'module' }),
    ),
    listener,
  );
}

export type ObjClient = Asked<ToObj, { readObj: ObjReadMessage }>;
export type StartObj = (listener: Listener<never>) => ObjClient;

/** Reads one mesh. */
export function startObjWorker(listener: Listener<never>): ObjClient {
  return createAsked(
    withCore(new Worker(new URL('../worker/obj-worker.ts', import.meta.url), { type: 'module' })),
    listener,
  );
}
