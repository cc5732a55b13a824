import createPleat from '../../wasm/pleat.mjs';
import { createMotionCore } from './motion-core';
import type { FromMotion, ToMotion } from './motion-protocol';

const post = (message: FromMotion, transfer: Transferable[]) =>
  self.postMessage(message, { transfer });
const core = createPleat().then((module) => createMotionCore(module, post));
core.catch((error) => post({ type: 'broken', reason: String(error) }, []));
self.onmessage = async (event: MessageEvent<ToMotion>) => (await core).receive(event.data);
