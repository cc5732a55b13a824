// The page's end of the workers of garments: each question has one answer.
import type { Failure } from '../../shared/bindings/answers';
import type { FromExample, FromGarment, ToExample, ToGarment } from '../worker/garment-protocol';

/** A worker that will not answer any more. */
export class BrokenWorker extends Error {}

/** What a question was refused with. */
export class Refused extends Error {
  constructor(readonly failure: Failure) {
    super(failure.what);
  }
}

export interface Asked<Question, Answer> {
  /** Rejects with Refused, or with BrokenWorker. Answers come in the order of questions. */
  ask(question: Question, transfer?: Transferable[]): Promise<Answer>;
  /** Ends the worker at once; open questions are rejected. */
  terminate(): void;
}

/** The part of a worker that is used. */
export interface Port<Question> {
  postMessage(message: Question, transfer: Transferable[]): void;
  terminate(): void;
  onmessage: ((event: MessageEvent) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
}

type WithType = { type: string };

/** Of a worker that answers each message with exactly one. */
export function createAsked<Question, Answer extends WithType>(
  port: Port<Question>,
): Asked<Question, Answer> {
  let waiting: { resolve(answer: Answer): void; reject(reason: Error): void }[] = [];
  let broken: BrokenWorker | null = null;

  function breakDown(reason: string): void {
    broken = new BrokenWorker(reason);
    for (const { reject } of waiting) reject(broken);
    waiting = [];
  }

  port.onmessage = ({ data }: MessageEvent<Answer>) => {
    if (data.type === 'broken') {
      return breakDown(String((data as unknown as { reason: string }).reason));
    }
    const next = waiting.shift();
    if (data.type !== 'refused') return next?.resolve(data);
    next?.reject(new Refused((data as unknown as { failure: Failure }).failure));
  };
  port.onerror = (event) => {
    event.preventDefault();
    breakDown(event.message || 'its program could not be loaded');
  };
  return {
    ask(question, transfer = []) {
      if (broken) return Promise.reject(broken);
      return new Promise((resolve, reject) => {
        waiting.push({ resolve, reject });
        port.postMessage(question, transfer);
      });
    },
    terminate() {
      port.terminate();
      breakDown('it was ended');
    },
  };
}

export type GarmentClient = Asked<ToGarment, FromGarment>;
export type ExampleClient = Asked<ToExample, FromExample>;

export function startGarmentWorker(): GarmentClient {
  return createAsked(
    new Worker(new URL('../worker/garment-worker.ts', import.meta.url), { type: 'module' }),
  );
}

export function startExampleWorker(): ExampleClient {
  return createAsked(
    new Worker(new URL('../worker/example-worker.ts', import.meta.url), { type: 'module' }),
  );
}
