// A worker that has a successor when it ends by itself: one at a time, until the work is done. It starts its
// successor unasked, and several parts of a view ask it as one worker. Restarts is for all others.
import type { AnswersTo, Asked, Listener, Message } from './asked';

export interface RenewedEvents {
  /** Another one took its place, with nothing loaded. */
  renewed(reason: string): void;
  /** None did: the first one never answered (`hasWorked` is false), or the successor ended as well. */
  lost(reason: string, hasWorked: boolean): void;
}

export class Renewed<Question extends Message, Answers extends AnswersTo<Question>>
  implements Asked<Question, Answers>
{
  private client: Asked<Question, Answers>;
  private hasAnswered = false;
  private hasEverAnswered = false; // one of the workers so far
  private isSuccessor = false; // it has not done its work yet

  constructor(
    private readonly start: (listener: Listener<never>) => Asked<Question, Answers>,
    private readonly events: RenewedEvents,
  ) {
    this.client = this.launch();
  }

  ask<Own extends Question>(
    question: Own,
    transfer: Transferable[] = [],
  ): Promise<Answers[Own['type']]> {
    const { client } = this;
    const answer = client.ask(question, transfer);
    const note = () => {
      this.hasAnswered ||= client === this.client;
      this.hasEverAnswered ||= this.hasAnswered;
    };
    answer.then(note, () => undefined);
    return answer;
  }

  tell(message: Question, transfer: Transferable[] = []): void {
    this.client.tell(message, transfer);
  }

  terminate(): void {
    this.client.terminate();
  }

  /** The work is done: if this one ends, it has a successor. */
  prove(): void {
    this.isSuccessor = false;
  }

  /** Ends it, whatever it is doing, and starts another one, which has nothing loaded. */
  replace(): void {
    this.client.terminate();
    this.client = this.launch();
  }

  private launch(): Asked<Question, Answers> {
    this.hasAnswered = false;
    return this.start({ broken: (reason) => this.end(reason) });
  }

  private end(reason: string): void {
    const hasWorked = this.hasEverAnswered || this.isSuccessor;
    if (!this.hasAnswered || this.isSuccessor) return this.events.lost(reason, hasWorked);
    this.isSuccessor = true;
    this.client = this.launch();
    this.events.renewed(reason);
  }
}
