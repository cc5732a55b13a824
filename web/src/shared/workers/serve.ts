// The worker's end of the page: takes one message after the other to the core, and sends back what comes of it.
import { describe } from '../bindings/answers';
import { type Refusal, refusalOf } from '../bindings/refusals';
import type { Done, Letter, Message, Reply } from './asked';
import type { CoreLetter } from './compiled-core';
import { prepareFor } from './later-core';
import { holdLife } from './life';

/** The part of a worker's scope that is used. */
export interface Scope {
  postMessage(message: Reply, options: { transfer: Transferable[] }): void;
  onmessage: ((event: MessageEvent) => void) | null;
}

/** Does the work of a worker. */
export interface Core<Question> {
  receive(message: Question): void | Promise<void>;
}

export type Post<Answer> = (message: Answer, transfer: Transferable[]) => void;

/** A core of a module, which refuses a message whose work throws. */
export abstract class ModuleCore<Module, Question, Answer> implements Core<Question> {
  constructor(
    protected readonly module: Module,
    protected readonly post: Post<Answer | Refusal>,
  ) {}

  receive(message: Question): void | Promise<void> {
    const refuse = (error: unknown) => this.post(refusalOf(error), []);
    try {
      return this.handle(message)?.catch(refuse);
    } catch (error) {
      refuse(error);
    }
  }

  /** Deletes what it made of the module. */
  abstract close(): void;
  protected abstract handle(message: Question): Promise<void> | undefined | void;
}

const DONE: Done = { type: 'done' };

/**
 * Serves a page with the core that `start` makes. The first message that the core posts while it has
 * a question is its answer, `done` when it posts none; all others are news.
 */
export function serve<Question, Answer extends Message>(
  scope: Scope,
  start: (post: Post<Answer>) => Promise<Core<Question>>,
): void {
  let asked: number | null = null;
  let isBroken = false;

  function post(message: Message, transfer: Transferable[]): void {
    const id = asked;
    asked = null;
    scope.postMessage({ id, message }, { transfer });
  }

  function breakDown(error: unknown): void {
    if (!isBroken) scope.postMessage({ broken: describe(error) }, { transfer: [] });
    isBroken = true;
  }

  holdLife((life) => scope.postMessage({ life }, { transfer: [] }));
  const core = start(post);
  let turn: Promise<unknown> = core;
  turn.catch(breakDown);
  scope.onmessage = ({ data }: MessageEvent<Letter<Question> | CoreLetter>) => {
    if ('core' in data) return; // givenCore takes it
    const { id, message } = data;
    turn = turn.then(async () => {
      asked = id;
      const ready = await core;
      await prepareFor(message);
      await ready.receive(message);
      if (asked !== null) post(DONE, []);
    });
    turn.catch(breakDown);
  };
}
