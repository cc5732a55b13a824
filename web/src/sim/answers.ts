// The texts that the modules answer with, and what went wrong in their stead.
import type { Answer, Failure } from './wasm-module';

/** Parses an answer; one that is not JSON is a fault of the program, not of the input. */
export function read<Payload>(text: string): Answer<Payload> {
  try {
    return JSON.parse(text) as Answer<Payload>;
  } catch {
    return internalFailure(`the module answered with unreadable text: ${text.slice(0, 120)}`);
  }
}

export function internalFailure(what: string): Failure {
  return { ok: false, kind: 'internal', where: '', what };
}

export function describe(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
