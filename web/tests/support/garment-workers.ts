// The workers of garments in this thread, with the real module and the records of the repository.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { RefinementModule } from '../../src/refinement/bindings/refinement-module';
import {
  createAsked,
  type ExampleClient,
  type GarmentClient,
  type Port,
} from '../../src/refinement/run/garment-client';
import { createExampleCore } from '../../src/refinement/worker/example-core';
import { createGarmentCore } from '../../src/refinement/worker/garment-core';
import type {
  FromExample,
  FromGarment,
  ToExample,
  ToGarment,
} from '../../src/refinement/worker/garment-protocol';

const root = fileURLToPath(new URL('../../..', import.meta.url));

/** A record by its address, wherever the page is served. */
export async function recordBytes(url: string): Promise<ArrayBuffer> {
  const path = /assets\/recordings\/.*$/.exec(url)?.[0];
  const bytes = readFileSync(`${root}/${path}`);
  return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength) as ArrayBuffer;
}

function portTo<Question>(
  receive: (message: Question) => Promise<void>,
  close: () => void,
): Port<Question> & { answer(message: unknown): void } {
  const port: Port<Question> & { answer(message: unknown): void } = {
    onmessage: null,
    onerror: null,
    postMessage: (message) => void receive(message),
    terminate: close,
    answer: (data) => port.onmessage?.({ data } as MessageEvent),
  };
  return port;
}

/** `log` gets every question. */
export function garmentClient(module: RefinementModule, log: ToGarment[] = []): GarmentClient {
  const core = createGarmentCore(module, (message: FromGarment) => port.answer(message));
  const port = portTo<ToGarment>(async (message) => {
    log.push(message);
    await core.receive(message);
  }, core.close);
  return createAsked<ToGarment, FromGarment>(port);
}

export function exampleClient(module: RefinementModule): ExampleClient {
  const core = createExampleCore(
    module,
    (message: FromExample) => port.answer(message),
    () => 0,
  );
  const port = portTo<ToExample>(core.receive, core.close);
  return createAsked<ToExample, FromExample>(port);
}
