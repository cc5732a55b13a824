// The core in a worker, made of what the page has compiled.
import createPleat from '../../wasm/pleat.mjs';
import type { CoreLetter } from './compiled-core';
import { takeModule } from './later-core';

/** The core's classes, or the part of them that the caller names. */
export async function givenCore<Part>(): Promise<Part> {
  const parts = await new Promise<WebAssembly.Module[]>((resolve) => {
    addEventListener('message', ({ data }: MessageEvent<CoreLetter | object>) => {
      if ('core' in data) resolve(data.core);
    });
  });
  const module = await createPleat<Part & object>({ parts });
  takeModule(module);
  return module;
}
