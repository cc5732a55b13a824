// The rest of the core, which a worker that has the first part alone joins when a scene needs it.
import rest from '../../wasm/pleat-rest.wasm?url';

/** A module; it cannot be joined where it has the rest. */
interface Joinable {
  join?: (rest: WebAssembly.Module) => Promise<unknown>;
}

let module: Joinable = {};
let joined: Promise<void> | null = null;

/** Takes the module that the worker works with. */
export function takeModule(made: Joinable): void {
  module = made;
  joined = null;
}

/** Self-contact, a box among colliders, whose size has to be there, or a mesh among them. */
const LATER = /"self_contact"|"size_m"|"colliders".*"mesh"/s;

/** True where a text in the message, however deep, names what only the rest of the core can do. */
export function namesLater(part: unknown): boolean {
  if (typeof part === 'string') return LATER.test(part);
  if (typeof part !== 'object' || part === null) return false;
  if (part instanceof ArrayBuffer || ArrayBuffer.isView(part)) return false;
  return Object.values(part).some(namesLater);
}

async function join(): Promise<void> {
  if (!module.join) return;
  const answer = await fetch(rest);
  await module.join(await WebAssembly.compile(await answer.arrayBuffer()));
}

/** Joins what the message needs, once; what failed is tried anew with the next message. */
export async function prepareFor(message: unknown): Promise<void> {
  if (!namesLater(message)) return;
  joined ??= join();
  joined.catch(() => {
    joined = null;
  });
  await joined;
}
