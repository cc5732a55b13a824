// The page's end of a worker: typed messages, and one sentence when the worker itself breaks.
import type { FromWorker, ToWorker } from './protocol';

export interface WorkerClient {
  send(message: ToWorker, transfer?: Transferable[]): void;
  /** Ends the worker at once, whatever it is doing. */
  terminate(): void;
}

/** Starts a worker with its own module. `onBroken` hears of a worker that cannot go on. */
export function startWorker(
  receive: (message: FromWorker) => void,
  onBroken: (reason: string) => void,
): WorkerClient {
  const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' });
  worker.onmessage = (event: MessageEvent<FromWorker>) => receive(event.data);
  worker.onerror = (event) => {
    event.preventDefault();
    onBroken(event.message || 'its program could not be loaded');
  };
  return {
    send: (message, transfer = []) => worker.postMessage(message, transfer),
    terminate: () => worker.terminate(),
  };
}
