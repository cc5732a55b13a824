import createSweep from '../wasm/sweep.mjs';
import type { FromWorker, SweepMessage } from './protocol';
import { runSweep } from './worker-core';

const post = (message: FromWorker, transfer: Transferable[]) =>
  self.postMessage(message, { transfer });
const module = createSweep();
module.catch((error) => post({ type: 'broken', reason: String(error) }, []));
self.onmessage = async (event: MessageEvent<SweepMessage>) =>
  runSweep(await module, event.data, post);
