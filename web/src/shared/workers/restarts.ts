// Starts of workers after one has ended by itself: once more, but not for ever.

/** Words on an end; `at` says when it was, as " at 1.20 s", or nothing. */
export function endedSentence(reason: string, at = ''): string {
  return `The computation ended by itself${at} (${reason.replace(/[.]$/, '')}).`;
}

/** Tells a first end from one that follows before any work was done. */
export class Restarts {
  private isProven = true;

  /** Work came to its end. */
  prove(): void {
    this.isProven = true;
  }

  /** False when nothing was done since the last start: another one would end as well. */
  mayStart(): boolean {
    const { isProven } = this;
    this.isProven = !isProven;
    return isProven;
  }
}
