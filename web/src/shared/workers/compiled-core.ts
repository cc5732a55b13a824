// The core's WebAssembly: the page fetches and compiles it once, and each worker instantiates what it is given.
import address from '../../wasm/pleat.wasm?url';

/** The first message to a worker. */
export interface CoreLetter {
  core: WebAssembly.Module;
}

let compiled: Promise<WebAssembly.Module> | null = null;

/** Compiles while it is fetched, where the server names the type that browsers want for that. */
async function compile(): Promise<WebAssembly.Module> {
  const response = await fetch(address);
  if (!response.ok) throw new Error(`its program could not be loaded: ${response.status}`);
  return response.headers.get('content-type') === 'application/wasm'
    ? WebAssembly.compileStreaming(response)
    : WebAssembly.compile(await response.arrayBuffer());
}

/** The compiled core; one that failed is tried anew with the next worker. */
function compiledCore(): Promise<WebAssembly.Module> {
  compiled ??= compile();
  compiled.catch(() => {
    compiled = null;
  });
  return compiled;
}

/** Gives a new worker the compiled core; what fails on the way is an error of the worker. */
export function withCore(worker: Worker): Worker {
  compiledCore().then(
    (core) => worker.postMessage({ core } satisfies CoreLetter),
    (error: Error) => worker.dispatchEvent(new ErrorEvent('error', { message: error.message })),
  );
  return worker;
}
