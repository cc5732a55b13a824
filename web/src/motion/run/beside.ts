// Measures beside the shown cloth, once its wish has rested.
import type { MeasuringClient, StartMeasuring } from './measuring-client';

export class Beside {
  private restHandle: ReturnType<typeof setTimeout> | undefined;
  private client: MeasuringClient | null = null;

  constructor(
    private readonly start: StartMeasuring,
    /** A wish that stands for so long rests [ms]. */
    private readonly restMs: number,
  ) {}

  /** Measures in place of whatever was wished before; `take` hears of it unless it is given up. */
  later<Result>(
    measure: (client: MeasuringClient) => Promise<Result>,
    take: (result: Result) => void,
  ): void {
    this.cancel();
    this.restHandle = setTimeout(async () => {
      const client = this.start({});
      this.client = client;
      const result = await measure(client);
      if (this.client !== client) return;
      this.cancel();
      take(result);
    }, this.restMs);
  }

  /** Gives up what is being measured. */
  cancel(): void {
    clearTimeout(this.restHandle);
    this.client?.terminate();
    this.client = null;
  }
}
