// The core's WebAssembly as it was built, for what runs in Node.
import { existsSync, readFileSync } from 'node:fs';

const fileOf = (name: string) => new URL(`../src/wasm/${name}`, import.meta.url);

/** Parts of the module: what a first visit needs, and the rest. */
const PARTS = ['pleat.wasm', 'pleat-rest.wasm'];

/** A core with all of its classes, or the part of them that the caller names. */
export async function builtCore<Part>(parts = PARTS): Promise<Part> {
  if (!parts.every((name) => existsSync(fileOf(name))))
    throw new Error('The WebAssembly module is not built: ./pleat test and ./pleat demo do.');
  const { default: create } = await import(/* @vite-ignore */ fileOf('pleat.mjs').href);
  const files = parts.map((name) => readFileSync(fileOf(name)));
  return create({ parts: await Promise.all(files.map((bytes) => WebAssembly.compile(bytes))) });
}

/** The core as a first visit has it: what is in the rest throws. */
export const firstCore = <Part>() => builtCore<Part>(PARTS.slice(0, 1));
