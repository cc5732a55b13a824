// Keeps what the worker has granted last, to go back to when it refuses what came after.
import { BrokenWorker } from '../../shared/workers/asked';

export class LastGranted<Value> {
  private nUnanswered = 0;

  constructor(public value: Value) {}

  /** True while the page shows what the worker has. */
  isSettled(): boolean {
    return this.nUnanswered === 0;
  }

  /**
   * Asks for something; then, once nothing is unanswered, keeps what was `granted`, or has it undone
   * by `refused` when the last answer was a refusal. A worker that is gone has neither.
   */
  async ask(
    question: Promise<unknown>,
    outcome: { granted(): Value; refused(): void },
  ): Promise<void> {
    this.nUnanswered += 1;
    let answer: 'granted' | 'refused' | 'none' = 'granted';
    try {
      await question;
    } catch (error) {
      answer = error instanceof BrokenWorker ? 'none' : 'refused';
      throw error;
    } finally {
      this.nUnanswered -= 1;
      if (this.isSettled() && answer === 'granted') this.value = outcome.granted();
      else if (this.isSettled() && answer === 'refused') outcome.refused();
    }
  }
}
