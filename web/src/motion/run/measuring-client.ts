// Starts the workers that measure beside the shown cloth.
import { type Asked, createAsked, type Done, type Listener } from '../../shared/workers/asked';
import type { RacedMessage, ToRace } from '../worker/race-protocol';
import type { FromSweep, PlannedMessage, ToSweep } from '../worker/sweep-protocol';

export type RaceClient = Asked<ToRace, { race: RacedMessage }>;
export type StartRace = (listener: Listener<never>) => RaceClient;

/** Times one scene. */
export function startRaceWorker(listener: Listener<never>): RaceClient {
  return createAsked(
    new Worker(new URL('../worker/race-worker.ts', import.meta.url), { type: 'module' }),
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
