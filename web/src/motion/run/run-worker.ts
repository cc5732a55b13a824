// The worker of a run: opened before its first question, watched while it is at work, and replaced when it
// is of no use any more.
import { fabricsText } from '../../shared/fabric/fabric-data';
import type { MotionClient, StartMotion } from '../../shared/workers/motion-client';
import type { FromMotion, MotionAnswers, ToMotion } from '../../shared/workers/motion-protocol';

/** How often work in hand is looked at [ms]. */
const LOOK_EVERY_MS = 250;

/** The question that is worked on, and for how long by now [ms]. */
export interface Work {
  type: ToMotion['type'];
  forMs: number;
}

export interface RunWorkerEvents {
  news(message: FromMotion): void;
  /** It cannot go on; `hasStarted`: it had begun to answer. */
  broken(reason: string, hasStarted: boolean): void;
  /** Heard while there is work in hand, and null once there is none. */
  atWork(work: Work | null): void;
}

export class RunWorker {
  private client: MotionClient;
  private readonly questions: ToMotion['type'][] = []; // not answered yet, in their order
  private sinceMs = 0; // the first of them is worked on since then
  private hasStarted = false;
  private lookHandle: ReturnType<typeof setTimeout> | null = null;

  constructor(
    private readonly start: StartMotion,
    private readonly events: RunWorkerEvents,
  ) {
    this.client = this.launch();
    this.open();
  }

  ask<Own extends ToMotion>(
    question: Own,
    transfer: Transferable[] = [],
  ): Promise<MotionAnswers[Own['type']]> {
    const { client } = this;
    if (this.questions.length === 0) this.sinceMs = performance.now();
    this.questions.push(question.type);
    const answer = client.ask(question, transfer);
    const strike = () => {
      if (client !== this.client) return;
      this.questions.shift();
      this.sinceMs = performance.now();
    };
    answer.then(strike, strike);
    this.lookLater();
    return answer;
  }

  tell(message: ToMotion): void {
    this.client.tell(message);
  }

  /** Ends the worker whatever it is doing, and starts another one, which has nothing loaded. */
  replace(): void {
    this.client.terminate();
    this.questions.length = 0;
    this.client = this.launch();
    this.open();
  }

  private launch(): MotionClient {
    this.hasStarted = false;
    return this.start({
      news: (message) => this.events.news(message),
      broken: (reason) => this.events.broken(reason, this.hasStarted),
    });
  }

  private open(): void {
    const { client } = this;
    const note = () => {
      this.hasStarted ||= client === this.client;
    };
    this.ask({ type: 'open', fabricsText }).then(note, () => undefined);
  }

  private lookLater(): void {
    this.lookHandle ??= setTimeout(() => {
      this.lookHandle = null;
      const [type] = this.questions;
      if (type) this.lookLater();
      this.events.atWork(type ? { type, forMs: performance.now() - this.sinceMs } : null);
    }, LOOK_EVERY_MS);
  }
}
