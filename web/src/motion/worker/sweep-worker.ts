import createSweep from '../../wasm/sweep.mjs';
import { runSweep } from './motion-core';
import type { FromMotion, SweepMessage } from './motion-protocol';

const post = (message: FromMotion, transfer: Transferable[]) =>
  self.postMessage(message, { transfer });
const module = createSweep();
module.catch((error) => post({ type: 'broken', reason: String(error) }, []));
self.onmessage = async (event: MessageEvent<SweepMessage>) =>
  runSweep(await module, event.data, post);
