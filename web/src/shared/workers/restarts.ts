// Ends of a worker by itself: whether another one is to take its place, and the words for it. It counts for
// owners that start that one themselves, when it suits them; Renewed starts it unasked.
import { quoted } from '../bindings/answers';

/** Counts how often in a row a worker has ended before it did its work. */
export class Restarts {
  private nInARow = 0;
  private hasStarted = false;

  /** It has answered: a worker can be had here. */
  noteStart(): void {
    this.hasStarted = true;
  }

  /** It did what it was asked for: its next end is the first one again. */
  noteWork(): void {
    this.hasStarted = true;
    this.nInARow = 0;
  }

  /** Notes an end. How many there were in a row; 0 of what never started, as another one would not either. */
  noteEnd(): number {
    if (this.hasStarted) this.nInARow += 1;
    return this.nInARow;
  }
}

/** The first sentence after an end; `at` says when it was, as " at 1.20 s", or nothing. */
export function endedSentence(reason: string, at = ''): string {
  return `The computation ended by itself${at} (${quoted(reason).replace(/[.]$/, '')}).`;
}
