// The workers of garments in this thread, with the real module and the records of the repository.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { RefinementModule } from '../../src/refinement/bindings/refinement-module';
import type { ExampleClient, GarmentClient } from '../../src/refinement/run/garment-client';
import { ExampleCore } from '../../src/refinement/worker/example-core';
import { GarmentCore } from '../../src/refinement/worker/garment-core';
import type {
  FromExample,
  FromGarment,
  ToExample,
  ToGarment,
} from '../../src/refinement/worker/garment-protocol';
import { createAsked } from '../../src/shared/workers/asked';
import { workerPort } from './worker-port';

const root = fileURLToPath(new URL('../../..', import.meta.url));

/** A record or a start by its address, wherever the page is served. */
export async function recordBytes(url: string): Promise<ArrayBuffer> {
  const path = /assets\/(recordings|starts)\/.*$/.exec(url)?.[0];
  const bytes = readFileSync(`${root}/${path}`);
  return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength) as ArrayBuffer;
}

/** `log` gets every question. */
export function garmentClient(module: RefinementModule, log: ToGarment[] = []): GarmentClient {
  const port = workerPort<ToGarment, FromGarment>((post) => {
    const core = new GarmentCore(module, post);
    return {
      receive(message) {
        log.push(message);
        return core.receive(message);
      },
      close: () => core.close(),
    };
  });
  return createAsked(port);
}

export function exampleClient(module: RefinementModule): ExampleClient {
  return createAsked(workerPort<ToExample, FromExample>((post) => new ExampleCore(module, post)));
}
