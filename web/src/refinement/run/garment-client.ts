// Starts the workers of garments: one for each pane, and one for the examples.
import type { Asked } from '../../shared/workers/asked';
import { startAsked, WHOLE } from '../../shared/workers/compiled-core';
import type {
  ExampleAnswers,
  GarmentAnswers,
  ToExample,
  ToGarment,
} from '../worker/garment-protocol';

export type GarmentClient = Asked<ToGarment, GarmentAnswers>;
export type ExampleClient = Asked<ToExample, ExampleAnswers>;

/** `onBroken` hears that it will not answer any more, and why, though nothing is asked. */
export function startGarmentWorker(onBroken: (reason: string) => void): GarmentClient {
  return startAsked(
    new Worker(new URL('../worker/garment-worker.ts', import.meta.url), { type: 'module' }),
    { broken: onBroken },
    WHOLE,
  );
}

export function startExampleWorker(): ExampleClient {
  return startAsked(
    new Worker(new URL('../worker/example-worker.ts', import.meta.url), { type: 'module' }),
    {},
    WHOLE,
  );
}
