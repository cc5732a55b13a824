// The page's end of its workers: typed messages, and one sentence when a worker itself breaks.
import type { FromDeform, ToDeform } from '../../fabrics/worker/deform-protocol';
import type { FromMotion, SweepMessage, ToMotion } from '../../motion/worker/motion-protocol';

export interface WorkerClient<Message> {
  send(message: Message, transfer?: Transferable[]): void;
  /** Ends the worker at once, whatever it is doing. */
  terminate(): void;
}

/** `onBroken` hears of a worker that cannot go on. */
function connect<Message, Answer>(
  worker: Worker,
  receive: (message: Answer) => void,
  onBroken: (reason: string) => void,
): WorkerClient<Message> {
  worker.onmessage = (event: MessageEvent<Answer>) => receive(event.data);
  worker.onerror = (event) => {
    event.preventDefault();
    onBroken(event.message || 'its program could not be loaded');
  };
  return {
    send: (message, transfer = []) => worker.postMessage(message, transfer),
    terminate: () => worker.terminate(),
  };
}

type Ends<Answer> = [receive: (message: Answer) => void, onBroken: (reason: string) => void];

/** Starts a worker that runs the shown cloth. */
export function startWorker(...ends: Ends<FromMotion>): WorkerClient<ToMotion> {
  const worker = new Worker(new URL('../../motion/worker/motion-worker.ts', import.meta.url), {
    type: 'module',
  });
  return connect(worker, ...ends);
}

/** Starts a worker that runs one sweep. */
export function startSweepWorker(...ends: Ends<FromMotion>): WorkerClient<SweepMessage> {
  const worker = new Worker(new URL('../../motion/worker/sweep-worker.ts', import.meta.url), {
    type: 'module',
  });
  return connect(worker, ...ends);
}

/** Starts a worker that finds the shapes of one cloth in several fabrics. */
export function startDeformWorker(...ends: Ends<FromDeform>): WorkerClient<ToDeform> {
  const worker = new Worker(new URL('../../fabrics/worker/deform-worker.ts', import.meta.url), {
    type: 'module',
  });
  return connect(worker, ...ends);
}
