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
import { createAsked, type Port } from '../../src/shared/workers/asked';
import { workerPort } from './worker-port';

const root = fileURLToPath(new URL('../../..', import.meta.url));

/** A record or a start by its address, wherever the page is served. */
export async function recordBytes(url: string): Promise<ArrayBuffer> {
  const path = /assets\/(recordings|starts)\/.*$/.exec(url)?.[0];
  const bytes = readFileSync(`${root}/${path}`);
  return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength) as ArrayBuffer;
}

function garmentPort(module: RefinementModule, log: ToGarment[]): Port {
  return workerPort<ToGarment, FromGarment>((post) => {
    const core = new GarmentCore(module, post);
    return {
      receive(message) {
        log.push(message);
        return core.receive(message);
      },
      close: () => core.close(),
    };
  });
}

/** `log` gets every question. */
export function garmentClient(module: RefinementModule, log: ToGarment[] = []): GarmentClient {
  return createAsked(garmentPort(module, log));
}

/** Workers that end when told to, one after the other, as the browser ends one. */
export function mortalWorkers(module: RefinementModule) {
  const ports: Port[] = [];
  return {
    start(broken: (reason: string) => void): GarmentClient {
      const port = garmentPort(module, []);
      ports.push(port);
      return createAsked(port, { broken });
    },
    nStarted: () => ports.length,
    /** Ends the worker that was started last. */
    endLast: (broken: string) => ports.at(-1)?.onmessage?.({ data: { broken } } as MessageEvent),
  };
}

export function exampleClient(module: RefinementModule): ExampleClient {
  return createAsked(workerPort<ToExample, FromExample>((post) => new ExampleCore(module, post)));
}
