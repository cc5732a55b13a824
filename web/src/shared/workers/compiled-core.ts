// The core's WebAssembly: the page fetches and compiles it once, and each worker instantiates what it is given.
import address from '../../wasm/pleat.wasm?url';
import { type AnswersTo, type Asked, createAsked, type Listener, type Message } from './asked';

/** The first message to a worker. */
export interface CoreLetter {
  core: WebAssembly.Module;
}

let compiled: Promise<WebAssembly.Module> | null = null;

/** Compiles while it is fetched; afterwards where the server does not name the type that browsers want for that. */
function compile(): Promise<WebAssembly.Module> {
  return WebAssembly.compileStreaming(fetch(address)).catch(async () =>
    WebAssembly.compile(await (await fetch(address)).arrayBuffer()),
  );
}

/** The compiled core; one that failed is tried anew with the next worker. */
function compiledCore(): Promise<WebAssembly.Module> {
  compiled ??= compile();
  compiled.catch(() => {
    compiled = null;
  });
  return compiled;
}

/** The page's end of a new worker, which is given the core; what fails on the way is an error of the worker. */
export function startAsked<
  Question extends Message,
  Answers extends AnswersTo<Question>,
  News = never,
>(worker: Worker, listener?: Listener<News>): Asked<Question, Answers> {
  compiledCore().then(
    (core) => worker.postMessage({ core } satisfies CoreLetter),
    (error: Error) => worker.dispatchEvent(new ErrorEvent('error', { message: error.message })),
  );
  return createAsked(worker, listener);
}
