import createPleat from '../../wasm/pleat.mjs';
import { createWorkerCore } from './motion-core';
import type { FromWorker, ToWorker } from './motion-protocol';

const post = (message: FromWorker, transfer: Transferable[]) =>
  self.postMessage(message, { transfer });
const core = createPleat().then((module) => createWorkerCore(module, post));
core.catch((error) => post({ type: 'broken', reason: String(error) }, []));
self.onmessage = async (event: MessageEvent<ToWorker>) => (await core).receive(event.data);
