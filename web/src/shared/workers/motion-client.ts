// Starts the worker that runs cloth in motion.
import type { Asked, Listener } from './asked';
import { startAsked } from './compiled-core';
import type { FromMotion, MotionAnswers, ToMotion } from './motion-protocol';

export type MotionClient = Asked<ToMotion, MotionAnswers>;
export type StartMotion = (listener: Listener<FromMotion>) => MotionClient;

export function startMotionWorker(listener: Listener<FromMotion>): MotionClient {
  return startAsked(
    new Worker(new URL('./motion-worker.ts', import.meta.url), { type: 'module' }),
    listener,
  );
}
