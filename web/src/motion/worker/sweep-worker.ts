import createSweep from '../../wasm/sweep.mjs';
import { runSweep } from './motion-core';
import type { FromWorker, SweepMessage } from './motion-protocol';

const post = (message: FromWorker, transfer: Transferable[]) =>
  self.postMessage(message, { transfer });
const module = createSweep();
module.catch((error) => post({ type: 'broken', reason: String(error) }, []));
self.onmessage = async (event: MessageEvent<SweepMessage>) =>
  runSweep(await module, event.data, post);
