// Starts the worker that finds the shapes of one cloth in several fabrics.
import type { Asked, Listener } from '../../shared/workers/asked';
import { startAsked, WHOLE } from '../../shared/workers/compiled-core';
import type { DeformAnswers, FromDeform, ToDeform } from '../worker/deform-protocol';

export type DeformClient = Asked<ToDeform, DeformAnswers>;
export type StartDeform = (listener: Listener<FromDeform>) => DeformClient;

export function startDeformWorker(listener: Listener<FromDeform>): DeformClient {
  return startAsked(
    new Worker(new URL('../worker/deform-worker.ts', import.meta.url), { type: 'module' }),
    listener,
    WHOLE,
  );
}
