// The page's end of a worker. A question has exactly one answer; what the worker says unasked is news.
import { type Failure, Refused } from '../bindings/answers';
import type { Refusal } from '../bindings/refusals';
import { watchLife } from './life';

/** A worker that will not answer any more. */
export class BrokenWorker extends Error {}

export interface Message {
  type: string;
}

/** The answer to a question that needs none but was asked. */
export interface Done {
  type: 'done';
}

/** A message from the page. `id` is null when it is told and not asked. */
export interface Letter<Question> {
  id: number | null;
  message: Question;
}

/**
 * A message of the worker: an answer with the id of its question, news without one, why it cannot go on, or
 * the lock that it holds for life.
 */
export type Reply = { id: number | null; message: Message } | { broken: string } | { life: string };

/** Answers of each type of question. */
export type AnswersTo<Question extends Message> = Record<Question['type'], Message>;

export interface Asked<Question extends Message, Answers extends AnswersTo<Question>> {
  /** Rejects with Refused, or with BrokenWorker. */
  ask<Own extends Question>(
    question: Own,
    transfer?: Transferable[],
  ): Promise<Answers[Own['type']]>;
  /** Wants no answer: whatever comes of it is news. */
  tell(message: Question, transfer?: Transferable[]): void;
  /** Ends the worker at once, whatever it is doing; open questions are rejected. */
  terminate(): void;
}

/** Hears what the worker sends unasked. */
export interface Listener<News> {
  news?(message: News): void;
  /** The worker cannot go on; its open questions are rejected as well. */
  broken?(reason: string): void;
}

/** The part of a worker that is used. */
export interface Port {
  postMessage(message: unknown, transfer: Transferable[]): void;
  terminate(): void;
  onmessage: ((event: MessageEvent) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
}

/** Why a worker is broken that ended without a word. */
const ENDED = 'the browser ended it without a word';

interface Waiting {
  resolve(answer: Message): void;
  reject(reason: Error): void;
}

function isRefusal(message: Message): message is Refusal {
  return message.type === 'refused';
}

export function createAsked<
  Question extends Message,
  Answers extends AnswersTo<Question>,
  News = never,
>(port: Port, listener: Listener<News> = {}): Asked<Question, Answers> {
  const waiting = new Map<number, Waiting>();
  let nAsked = 0;
  let broken: BrokenWorker | null = null;

  function breakDown(reason: string): void {
    broken = new BrokenWorker(reason);
    for (const { reject } of waiting.values()) reject(broken);
    waiting.clear();
  }

  function hearBroken(reason: string): void {
    if (broken) return;
    breakDown(reason);
    listener.broken?.(reason);
  }

  port.onmessage = ({ data }: MessageEvent<Reply>) => {
    if ('broken' in data) return hearBroken(data.broken);
    if ('life' in data) return watchLife(data.life, () => hearBroken(ENDED));
    const { id, message } = data;
    if (id === null) return listener.news?.(message as News);
    const asker = waiting.get(id);
    waiting.delete(id);
    if (isRefusal(message)) asker?.reject(new Refused(message.failure));
    else asker?.resolve(message);
  };
  port.onerror = (event) => {
    event.preventDefault();
    hearBroken(event.message || 'its program could not be loaded');
  };

  function post(id: number | null, message: Question, transfer: Transferable[]): void {
    port.postMessage({ id, message } satisfies Letter<Question>, transfer);
  }

  return {
    ask<Own extends Question>(question: Own, transfer: Transferable[] = []) {
      if (broken) return Promise.reject(broken);
      nAsked += 1;
      const id = nAsked;
      const answer = new Promise<Message>((resolve, reject) => {
        waiting.set(id, { resolve, reject });
      });
      post(id, question, transfer);
      return answer as Promise<Answers[Own['type']]>;
    },
    tell: (message, transfer = []) => post(null, message, transfer),
    terminate() {
      breakDown('it was ended');
      port.terminate();
    },
  };
}

/**
 * The answer; null when it was refused, which `onRefused` hears, or when the worker is broken, which
 * its listener hears.
 */
export async function answerOf<Answer>(
  question: Promise<Answer>,
  onRefused: (failure: Failure) => void,
): Promise<Answer | null> {
  try {
    return await question;
  } catch (error) {
    if (error instanceof Refused) onRefused(error.failure);
    else if (!(error instanceof BrokenWorker)) throw error;
    return null;
  }
}
