import createDeform from '../../wasm/deform.mjs';
import { createDeformCore } from './deform-core';
import type { FromDeform, ToDeform } from './deform-protocol';

const post = (message: FromDeform, transfer: Transferable[]) =>
  self.postMessage(message, { transfer });
// Between two slices of work the messages that came meanwhile get their turn.
const turns = new MessageChannel();
const core = createDeform().then((module) =>
  createDeformCore(module, post, {
    later: () => turns.port2.postMessage(null),
    nowMs: () => performance.now(),
  }),
);
core.catch((error) => post({ type: 'broken', reason: String(error) }, []));
turns.port1.onmessage = async () => (await core).advance();
self.onmessage = async (event: MessageEvent<ToDeform>) => (await core).receive(event.data);
