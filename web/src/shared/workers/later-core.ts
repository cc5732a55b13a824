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

/** True where a text in the message, however deep, names self-contact. */
export function namesSelfContact(part: unknown): boolean {
  if (typeof part === 'string') return part.includes('"self_contact"');
  if (typeof part !== 'object' || part === null) return false;
  if (part instanceof ArrayBuffer || ArrayBuffer.isView(part)) return false;
  return Object.values(part).some(namesSelfContact);
}

async function join(): Promise<void> {
  if (!module.join) return;
  const answer = await fetch(rest);
  await module.join(await WebAssembly.compile(await answer.arrayBuffer()));
}

/** Joins what the message needs, once; what failed is tried anew with the next message. */
export async function prepareFor(message: unknown): Promise<void> {
  if (!namesSelfContact(message)) return;
  joined ??= join();
  joined.catch(() => {
    joined = null;
  });
  await joined;
}
