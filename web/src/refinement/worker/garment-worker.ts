import createRefinement from '../../wasm/refinement.mjs';
import { createGarmentCore } from './garment-core';
import type { FromGarment, ToGarment } from './garment-protocol';

const post = (message: FromGarment, transfer: Transferable[]) =>
  self.postMessage(message, { transfer });
const core = createRefinement().then((module) => createGarmentCore(module, post));
core.catch((error) => post({ type: 'broken', reason: String(error) }, []));
self.onmessage = async (event: MessageEvent<ToGarment>) => (await core).receive(event.data);
