import createRefinement from '../../wasm/refinement.mjs';
import { createExampleCore } from './example-core';
import type { FromExample, ToExample } from './garment-protocol';

const post = (message: FromExample, transfer: Transferable[]) =>
  self.postMessage(message, { transfer });
const core = createRefinement().then((module) =>
  createExampleCore(module, post, () => performance.now()),
);
core.catch((error) => post({ type: 'broken', reason: String(error) }, []));
self.onmessage = async (event: MessageEvent<ToExample>) => (await core).receive(event.data);
