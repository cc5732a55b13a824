// The core's WebAssembly: the page fetches and compiles each part once, and each worker instantiates what it is given.

import first from '../../wasm/pleat.wasm?url';
import rest from '../../wasm/pleat-rest.wasm?url';
import { type AnswersTo, type Asked, createAsked, type Listener, type Message } from './asked';

/** The first message to a worker: the parts of the core, compiled. */
export interface CoreLetter {
  core: WebAssembly.Module[];
}

/** Addresses of what a first visit shows and measures. */
const FIRST = [first];

/** Addresses of all: of what convergence and the views of fabrics, modes and refinement need. */
export const WHOLE = [first, rest];

const compiled = new Map<string, Promise<WebAssembly.Module>>();

/** Compiles while it is fetched; afterwards where the server does not name the type that browsers want for that. */
function compile(address: string): Promise<WebAssembly.Module> {
  return WebAssembly.compileStreaming(fetch(address)).catch(async () =>
    WebAssembly.compile(await (await fetch(address)).arrayBuffer()),
  );
}

/** A compiled part; one that failed is tried anew with the next worker. */
function compiledPart(address: string): Promise<WebAssembly.Module> {
  const part = compiled.get(address) ?? compile(address);
  compiled.set(address, part);
  part.catch(() => compiled.delete(address));
  return part;
}

/** The page's end of a new worker, which is given the core; what fails on the way is an error of the worker. */
export function startAsked<
  Question extends Message,
  Answers extends AnswersTo<Question>,
  News = never,
>(worker: Worker, listener?: Listener<News>, parts = FIRST): Asked<Question, Answers> {
  Promise.all(parts.map(compiledPart)).then(
    (core) => worker.postMessage({ core } satisfies CoreLetter),
    (error: Error) => worker.dispatchEvent(new ErrorEvent('error', { message: error.message })),
  );
  return createAsked(worker, listener);
}
