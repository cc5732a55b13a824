// Starts the workers that measure beside the shown cloth.
import type { Asked, Done, Listener } from '../../shared/workers/asked';
import { startAsked, WHOLE } from '../../shared/workers/compiled-core';
import type { FromConvergence, ToConvergence } from '../worker/convergence-protocol';
import type { RacedMessage, StudiedMessage, ToMeasuring } from '../worker/measuring-protocol';
import type { FromSweep, PlannedMessage, ToSweep } from '../worker/sweep-protocol';

export type MeasuringClient = Asked<
  ToMeasuring,
  { race: RacedMessage; studyResponse: StudiedMessage }
>;
export type StartMeasuring = (listener: Listener<never>) => MeasuringClient;

/** Measures one scene. */
export function startMeasuringWorker(listener: Listener<never>): MeasuringClient {
  return startAsked(
    new Worker(new URL('../worker/measuring-worker.ts', import.meta.url), { type: 'module' }),
    listener,
  );
}

export type SweepClient = Asked<ToSweep, { plan: PlannedMessage; keep: Done; measure: Done }>;
export type StartSweep = (listener: Listener<FromSweep>) => SweepClient;

/** Runs one sweep, told to; its reports are news. */
export function startSweepWorker(listener: Listener<FromSweep>): SweepClient {
  return startAsked(
    new Worker(new URL('../worker/sweep-worker.ts', import.meta.url), { type: 'module' }),
    listener,
  );
}

export type ConvergenceClient = Asked<ToConvergence, { studyConvergence: Done }>;
export type StartConvergence = (listener: Listener<FromConvergence>) => ConvergenceClient;

/** Compares methods on one step, told to: how far it is, and what comes of it, is news. */
export function startConvergenceWorker(listener: Listener<FromConvergence>): ConvergenceClient {
  return startAsked(
    new Worker(new URL('../worker/convergence-worker.ts', import.meta.url), { type: 'module' }),
    listener,
    WHOLE,
  );
}
