// Starts the worker of one side.
import { type Asked, createAsked, type Listener } from '../../shared/workers/asked';
import { withCore } from '../../shared/workers/compiled-core';
import type { FromMotion, MotionAnswers, ToMotion } from '../../shared/workers/motion-protocol';

export type SideClient = Asked<ToMotion, MotionAnswers>;
export type StartSide = (listener: Listener<FromMotion>) => SideClient;

export function startSideWorker(listener: Listener<FromMotion>): SideClient {
  return createAsked(
    withCore(
      new Worker(new URL('../worker/failures-worker.ts', import.meta.url), { type: 'module' }),
    ),
    listener,
  );
}
