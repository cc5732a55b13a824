// Starts the workers of cloth in motion.
import { type Asked, createAsked, type Done, type Listener } from '../../shared/workers/asked';
import type { FromMotion, MotionAnswers, ToMotion } from '../worker/motion-protocol';
import type { ObjReadMessage, ToObj } from '../worker/obj-protocol';
import type { FromSweep, PlannedMessage, ToSweep } from '../worker/sweep-protocol';

export type MotionClient = Asked<ToMotion, MotionAnswers>;
export type StartMotion = (listener: Listener<FromMotion>) => MotionClient;

/** Runs the shown cloth. */
export function startMotionWorker(listener: Listener<FromMotion>): MotionClient {
  return createAsked(
    new Worker(new URL('../worker/motion-worker.ts', import.meta.url), { type: 'module' }),
    listener,
  );
}

export type ObjClient = Asked<ToObj, { readObj: ObjReadMessage }>;
export type StartObj = (listener: Listener<never>) => ObjClient;

/** Reads one mesh. */
export function startObjWorker(listener: Listener<never>): ObjClient {
  return createAsked(
    new Worker(new URL('../worker/obj-worker.ts', import.meta.url), { type: 'module' }),
    listener,
  );
}

export type SweepClient = Asked<ToSweep, { plan: PlannedMessage; keep: Done; measure: Done }>;
export type StartSweep = (listener: Listener<FromSweep>) => SweepClient;

/** Runs one sweep, told to; its reports are news. */
export function startSweepWorker(listener: Listener<FromSweep>): SweepClient {
  return createAsked(
    new Worker(new URL('../worker/sweep-worker.ts', import.meta.url), { type: 'module' }),
    listener,
  );
}
