// Keeps what the worker has granted last, to go back to when it refuses what came after.

export class LastGranted<Value> {
  private nUnanswered = 0;

  constructor(public value: Value) {}

  /** True while the page shows what the worker has. */
  isSettled(): boolean {
    return this.nUnanswered === 0;
  }

  /**
   * Asks for something; then, once nothing is unanswered, keeps what was `granted`, or has it undone
   * by `refused` when the last answer was a refusal.
   */
  async ask(
    question: Promise<unknown>,
    outcome: { granted(): Value; refused(): void },
  ): Promise<void> {
    this.nUnanswered += 1;
    let isGranted = true;
    try {
      await question;
    } catch (error) {
      isGranted = false;
      throw error;
    } finally {
      this.nUnanswered -= 1;
      if (this.isSettled() && isGranted) this.value = outcome.granted();
      else if (this.isSettled()) outcome.refused();
    }
  }
}
