// The texts that the WebAssembly modules answer with, and what says that something went wrong.

/** Every text answer: the payload beside `ok`, or one sentence about what was wrong and where. */
export type Answer<Payload> = ({ ok: true } & Payload) | Failure;

export interface Failure {
  ok: false;
  /** `input`: the scene or plan is at fault. `internal`: the program is. */
  kind: 'input' | 'internal';
  /** JSON pointer into the text that was passed, or empty. */
  where: string;
  what: string;
}

export interface RunStatus {
  status: string;
  message: string;
}

/** Parses an answer; one that is not JSON is a fault of the program, not of the input. */
export function read<Payload>(text: string): Answer<Payload> {
  try {
    return JSON.parse(text) as Answer<Payload>;
  } catch {
    return internalFailure(`the module answered with unreadable text: ${text.slice(0, 120)}`);
  }
}

export function inputFailure(what: string): Failure {
  return { ok: false, kind: 'input', where: '', what };
}

export function internalFailure(what: string): Failure {
  return { ok: false, kind: 'internal', where: '', what };
}

/** The error of what was refused. */
export class Refused extends Error {
  constructor(readonly failure: Failure) {
    super(failure.what);
  }
}

/** The payload of an answer; throws Refused where there is none. */
export function granted<Payload>(text: string): Payload {
  const answer = read<Payload>(text);
  if (answer.ok) return answer;
  throw new Refused(answer);
}

/** Letters of a technical reason that are quoted at most. */
const MOST_REASON = 100;

export function quoted(reason: string): string {
  return reason.slice(0, MOST_REASON);
}

/** One sentence for a failure, with the place in the scene when there is one. */
export function sentenceOf({ kind, where, what }: Failure): string {
  const place = where && !what.includes(where) ? `${where}: ` : '';
  const prefix = kind === 'internal' ? 'The program failed: ' : '';
  return `${prefix}${place}${what}`;
}

/** The sentence when a worker breaks without which `subject` cannot be computed. */
export function brokenSentence(subject: string, reason: string): string {
  return `${subject} cannot be computed: the WebAssembly part did not start (${quoted(reason)}). It needs a current browser, with SIMD and exceptions in WebAssembly; if this is one, check the connection and reload.`;
}

export function describe(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
